#pragma once
// The scene file (TOML): the only place that knows its keys, degrees and the units of users.

#include "canopy/mesh.h"
#include "io/source_files.h"
#include "light/sun.h"
#include "light/weather.h"
#include "transport/accuracy.h"
#include "transport/model.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

struct CameraPose {
  glm::dvec3 position_m{0.0};
  glm::dvec3 look_at_m{0.0};
  double fov_rad = 0.0;  // vertical
};

// Date, time and place, where the scene gives them instead of the sun's angles.
struct SunMoment {
  UtcTime time;
  Place place;
  int offset_minutes = 0;  // of the time as written, east of Greenwich positive
};

// Where a band's light comes from: a share of the weather's broadband irradiance, or the fixed rest of these, W m-2.
struct BandLight {
  std::optional<double> share;
  double direct_w_m2 = 0.0;         // on a horizontal plane, while the sun is up
  double direct_normal_w_m2 = 0.0;  // on a plane that faces the sun
  double diffuse_w_m2 = 0.0;        // on a horizontal plane
  std::string direct_place;         // of the key `direct`, for messages; empty without one
};

// What the scene says of its light at any time; moment_light.h makes irradiances of it.
struct SceneLight {
  std::vector<BandLight> bands;  // [waveband]
  std::optional<Weather> weather;
  std::string weather_place;  // of its table, for messages
  std::optional<SkyModel> sky;
  bool sky_from_weather = false;  // all_weather, with dni and dhi of the moment's weather
};

// model.sun, bands and sky are the light of the scene's own moment: direct_w_m2 is 0 with the sun below the horizon.
// model.optics: soil elements (names soil, soil2, ...) without [optics.NAME] of their own have the reflectance and colour of
// [soil] on both faces and transmit nothing.
struct Scene {
  std::string title;  // the file's stem where it has none
  std::filesystem::path file;
  // Every file that it was read from, as SourceFiles lists them; first what `access.files` held before.
  std::vector<SourceFile> files;
  // 16 hexadecimal digits: FNV-1a, 64 bits, over the scene's text and the digests of the files that the text names and that
  // those name in turn. Where the files lie does not matter.
  std::string digest;
  RadiationModel model;
  SceneLight light;
  std::optional<SunMoment> moment;
  Accuracy accuracy;
  std::optional<CameraPose> camera;
  std::vector<std::string> warnings;  // one line each, to be said once
};

// What a scene is read for. A day takes the light of its steps from light_at: the model's bands have none yet, and the
// scene's own moment need not lie in its weather file nor have the sun up.
enum class ScenePurpose { moment, day };

struct SceneAccess {
  bool allow_outside = false;  // may files lie outside the scene's folder?
  ScenePurpose purpose = ScenePurpose::moment;
  SourceFiles* files = nullptr;  // where given, gets every file that is tried, also if reading the scene then fails
};

// Reads, checks and assembles a scene. Throws Error (input), one line `file:line: key ...`, before any work starts.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const SceneAccess& access = {});

// A scene that is at hand as text, and meshes at hand as triangles.
struct SceneText {
  std::filesystem::path file;  // its name in messages; files that the text names are looked for in its folder. Need not exist
  std::string text;            // TOML, with the keys of a scene file
  std::map<std::string, Mesh> meshes;  // what `mesh = "NAME"` stands for in a [[geometry]], in place of `file`
};

// The same for such a scene. A mesh goes through `up`, `scale`, `heading` and `at` like one from a file (y is up unless told
// otherwise); besides, refuses meshes whose arrays do not fit together or hold numbers that are not finite.
[[nodiscard]] Scene read_scene(const SceneText& source, const SceneAccess& access = {});

// Gives a scene all that a text says but geometry, which is not looked at: the canopy stays as it is. Warnings are those of the
// new light; the files of the text are added to the scene's. Throws Error (input), and leaves the scene as it was, besides for
// optics that the canopy uses and the text does not define, and for another plot, layers or soil cells than the scene has: its
// tree and counters were made for these.
void relight(Scene& scene, const SceneText& source, const SceneAccess& access = {});

}  // namespace sunfleck

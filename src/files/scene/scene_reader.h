#pragma once
// Reads the scene file (TOML). Within the program, lengths are metres, angles radians and axes those of the scene.

#include "base/source_files.h"
#include "physics/canopy/mesh.h"
#include "physics/light/sun.h"
#include "physics/light/weather.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/model.h"

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

// Date, time and place, if the scene gives them instead of the sun's angles.
struct SunMoment {
  UtcTime time;
  Place place;
  int offset_minutes = 0;  // offset of the time as written from UTC, positive to the east
};

// The light of a band: a share of the weather's broadband irradiance, or the fixed irradiances below, W m-2.
struct BandLight {
  std::optional<double> share;
  double direct_w_m2 = 0.0;         // on a horizontal plane, while the sun is up
  double direct_normal_w_m2 = 0.0;  // on a plane facing the sun
  double diffuse_w_m2 = 0.0;        // on a horizontal plane
  std::string direct_place;         // location of the key `direct`, for messages; empty without one
};

// The scene's definition of its light at any time; moment_light.h turns it into irradiances.
struct SceneLight {
  std::vector<BandLight> bands;  // [waveband]
  std::optional<Weather> weather;
  std::string weather_place;  // location of its table, for messages
  std::optional<SkyModel> sky;
  bool sky_from_weather = false;  // true for all_weather with dni and dhi of the weather at each moment
};

// A scene as read. model.sun, bands and sky are the light at the scene's own time; direct_w_m2 is 0 if the sun is below the
// horizon. In model.optics, soil elements (names soil, soil2, ...) without an [optics.NAME] of their own have the reflectance
// and colour of [soil] on both faces and transmit nothing.
struct Scene {
  std::string title;  // default: the stem of the file name
  std::filesystem::path file;
  std::string text;  // TOML; empty after `relight`
  // All files that the scene was read from, as in SourceFiles, preceded by the earlier content of `access.files`.
  std::vector<SourceFile> files;
  // 16 hexadecimal digits: 64-bit FNV-1a over the text of the scene and the digests of all files it names, directly or
  // indirectly. The locations of the files do not matter.
  std::string digest;
  RadiationModel model;
  SceneLight light;
  std::optional<SunMoment> moment;
  Accuracy accuracy;
  std::optional<CameraPose> camera;
  std::vector<std::string> warnings;  // one line each, to be shown once
};

// The purpose of reading a scene. A day takes the light of its steps from light_of_step, so the bands of the model have no
// irradiance yet; the scene's own time need not lie in its weather file, and the sun may be down then.
enum class ScenePurpose { moment, day };

struct SceneAccess {
  bool allow_outside = false;  // true if files may lie outside the scene's folder
  ScenePurpose purpose = ScenePurpose::moment;
  SourceFiles* files = nullptr;              // if set, collects every file that is tried, even if reading then fails
  std::vector<std::filesystem::path> named;  // files that the user named, which may lie anywhere
};

// Reads, checks and assembles a scene. Throws Error (input), one line `file:line: key ...`, before any work starts.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const SceneAccess& access = {});

// A scene in memory: its text, and its meshes as triangles.
struct SceneText {
  // The name used in messages; files named in the text are looked up in its folder. It need not exist.
  std::filesystem::path file;
  std::string text;  // TOML, with the keys of a scene file
  // The meshes that `mesh = "NAME"` in a [[geometry]] refers to, instead of `file`.
  std::map<std::string, Mesh> meshes;
};

// Reads a scene from memory. `up`, `scale`, `heading` and `at` apply to a mesh as to one from a file (by default y is up, or z
// with the axes east_north_up). In addition, refuses meshes whose arrays do not fit together or hold numbers that are not
// finite.
[[nodiscard]] Scene read_scene(const SceneText& source, const SceneAccess& access = {});

// Gives a scene everything that a text defines except geometry, which is ignored; the canopy stays as it is. The warnings
// become those of the new light, and the files of the text are added to those of the scene. Throws Error (input) and leaves the
// scene unchanged; in addition to the errors of read_scene, this happens if the text does not define optics that the canopy
// uses, or changes the axes, the plot, the layers or the soil cells, because the tree and the counters were built for those.
void relight(Scene& scene, const SceneText& source, const SceneAccess& access = {});

}  // namespace sunfleck

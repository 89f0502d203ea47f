#pragma once
// The scene file (TOML): the only place that knows its keys, degrees and the units of users.

#include "light/sun.h"
#include "transport/accuracy.h"
#include "transport/model.h"

#include <cstdint>
#include <filesystem>
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

// model.bands: direct_w_m2 is 0 with the sun below the horizon. model.optics: soil elements (names soil, soil2, ...) without
// [optics.NAME] of their own have the reflectance and colour of [soil] on both faces and transmit nothing.
struct Scene {
  std::string title;  // the file's stem where it has none
  std::filesystem::path file;
  std::string digest;  // 16 hexadecimal digits: FNV-1a, 64 bits, over the scene's text and the bytes of every mesh file
  RadiationModel model;
  std::optional<SunMoment> moment;
  Accuracy accuracy;
  std::optional<CameraPose> camera;
  std::vector<std::string> warnings;  // one line each, to be said once
};

struct SceneAccess {
  bool allow_outside = false;  // may mesh files lie outside the scene's folder?
};

// Reads, checks and assembles a scene. Throws Error (input), one line `file:line: key ...`, before any work starts.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const SceneAccess& access = {});

}  // namespace sunfleck

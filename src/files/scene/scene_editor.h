#pragma once
// Writes a scene again with another title, light, optics or bounds. It knows the keys of a scene file, as scene_reader does.

#include "physics/canopy/optics.h"
#include "physics/light/sky_model.h"
#include "physics/light/sun.h"
#include "physics/transport/model/accuracy.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sunfleck {

// A table of the scene that stays as the text has it.
struct Unchanged {};
// A table that the scene shall not have.
struct Absent {};

struct SunByAngles {
  double elevation_deg = 0.0, azimuth_deg = 0.0;  // -90..90, -360..360
};
struct SunByClock {
  UtcTime local_time;      // as the clocks of the place show it, to the second
  int offset_minutes = 0;  // local time minus UTC
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// What is to differ from a scene. Members left as they are here change nothing.
struct SceneEdits {
  std::optional<std::string> title;
  std::variant<Unchanged, Absent, SunByAngles, SunByClock> sun;
  std::variant<Unchanged, Absent, SkyModel> sky;  // of any kind but `lights`, which only a file holds
  // All bands, in the scene's order, with irradiances that then replace its weather and whatever else it says of their light.
  std::vector<Waveband> irradiances;
  std::vector<SurfaceOptics> optics;     // surfaces whose coefficients change; rgb, role and emission stay
  std::vector<double> soil_reflectance;  // [band]
  std::optional<Accuracy> accuracy;      // its `direct` and `indirect`
  // Returns the new name of a file that the scene names, or nothing where it keeps its name.
  std::function<std::optional<std::string>(const std::string&)> renamed_file;
};

// Returns the text of a scene with these edits; its comments are lost. `band_names` are the names of the scene's bands, in its
// order. Messages refer to the text as `file`, a printable name. Throws Error (input) for a text that is not valid TOML.
[[nodiscard]] std::string edited_scene_text(const std::string& file, std::string_view text,
                                            const std::vector<std::string>& band_names, const SceneEdits& edits);

}  // namespace sunfleck

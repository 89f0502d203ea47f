#pragma once
// Warns about sunlight that cannot be: too strong for a beam, in another unit, from an angle in another convention.

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"

#include <string>
#include <vector>

namespace sunfleck {

// Total solar irradiance at the mean distance of the sun, W m-2 (Kopp and Lean 2011).
inline constexpr double solar_constant_w_m2 = 1361.0;

// Returns warnings about [sun] and the fixed light of each [[band]] of a scene whose light has been read. Each names its place
// and the number that would be right. A beam is compared with the light outside the atmosphere, at the sun's distance of the
// scene's date, or at its mean distance if the scene has no date.
[[nodiscard]] std::vector<std::string> light_warnings(const TomlTable& root, const Scene& scene);

// Returns warnings about surfaces that emit light though their role or name says that they are leaves. `root` locates them.
[[nodiscard]] std::vector<std::string> emission_warnings(const TomlTable& root, const RadiationModel& model);

}  // namespace sunfleck

#pragma once
// Reads CARIBU's lists of light directions, `.light`.

#include "io/source_files.h"
#include "light/sky.h"

#include <filesystem>
#include <vector>

namespace sunfleck {

inline constexpr std::size_t most_lights = 100'000;

// One direction a line, `weight dx dy dz`: its share of the irradiance of a horizontal plane, and the direction of travel, of
// any length, downwards (dz < 0), in z-up axes with x east and y north: to_sky = -(-dy, dz, -dx). Blank lines and what follows
// a # are ignored. Weights are as in the file, not scaled. Throws Error (input), one line with file and line: a missing or
// empty file, a line that has not four finite numbers, a negative weight, a direction that is level or upwards, no weight above
// 0, more lines than most_lights. `files`, where given, gets it.
[[nodiscard]] std::vector<SkyLight> read_lights(const std::filesystem::path& file, SourceFiles* files = nullptr);

}  // namespace sunfleck

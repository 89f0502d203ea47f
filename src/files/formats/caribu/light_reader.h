#pragma once
// Reads CARIBU lists of light directions, `.light`.

#include "base/source_files.h"
#include "physics/light/sky_model.h"

#include <filesystem>
#include <vector>

namespace sunfleck {

inline constexpr std::size_t most_lights = 100'000;

// Reads one direction per line, `weight dx dy dz`: its share of the irradiance on a horizontal plane, and the direction of
// travel, of any length and downwards (dz < 0), in z-up axes with x east and y north: to_sky = -(-dy, dz, -dx). Ignores blank
// lines and whatever follows a #. The weights are returned unscaled. Throws Error (input), one line with file and line, for a
// missing or empty file, a line without exactly four finite numbers, a negative weight, a direction that is level or upwards,
// no weight above 0, or more lines than most_lights. Adds the file to `files` if that is given.
[[nodiscard]] std::vector<SkyLight> read_lights(const std::filesystem::path& file, SourceFiles* files = nullptr);

}  // namespace sunfleck

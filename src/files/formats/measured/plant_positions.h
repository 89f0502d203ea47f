#pragma once
// Positions of plants in a field, measured or laid out by the user.

#include "base/source_files.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace sunfleck {

// The column of the height: y of positions with x south and z west, or z of those with x east and y north.
enum class HeightColumn { y, z };

struct PlantPosition {
  std::optional<std::uint32_t> plant;      // its number in the results, all different
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // as in the file
  double heading_deg = 0.0;                // clockwise as seen from above
  double scale = 1.0;                      // > 0
};

// Reads a table (number_table.h) with the columns x and z (or y, if z is the height), and optionally plant, the height (0
// without it), heading and scale, in any order. Adds the file to `files` if that is given. Throws Error (input), one line
// `FILE:LINE: ...`, for unknown, missing or double columns, empty cells, numbers out of range and plants that occur twice.
[[nodiscard]] std::vector<PlantPosition> read_plant_positions(const std::filesystem::path& file,
                                                              HeightColumn height = HeightColumn::y,
                                                              SourceFiles* files = nullptr);

}  // namespace sunfleck

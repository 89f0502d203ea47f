#pragma once
// Factors between units, and the figure that stands for a missing value.

#include <limits>
#include <numbers>

namespace sunfleck {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();  // an empty cell of a table

inline constexpr double degree = std::numbers::pi / 180.0;  // rad

[[nodiscard]] constexpr double in_degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

}  // namespace sunfleck

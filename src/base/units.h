#pragma once
// Factors between units.

#include <numbers>

namespace sunfleck {

inline constexpr double degree = std::numbers::pi / 180.0;  // rad

[[nodiscard]] constexpr double in_degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

}  // namespace sunfleck

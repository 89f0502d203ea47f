#pragma once
// Factors between units.

#include <numbers>

namespace sunfleck {

inline constexpr double degree = std::numbers::pi / 180.0;  // rad

}  // namespace sunfleck

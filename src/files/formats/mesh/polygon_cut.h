#pragma once
// Cuts polygons into triangles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

using CornerTriangle = std::array<std::uint32_t, 3>;

// Ears are cut off polygons of at most this many corners, which takes time in proportion to more than the square of their number.
inline constexpr std::size_t most_corners_with_ears = 1000;

// Returns whether some triangle of the fan about the first corner faces the other way than the polygon, so that the fan folds over
// itself.
[[nodiscard]] bool fan_folds(std::span<const glm::dvec3> corners);

// Returns the triangles of a polygon without holes whose fan folds, as numbers of its corners: two fewer than it has corners, each
// of which turns as the polygon does. Ears are cut off one by one (Meisters 1975, Am. Math. Mon. 82:648). A polygon that crosses
// itself is cut as well, but its triangles may overlap. Requires at least 3 corners, and at most most_corners_with_ears.
[[nodiscard]] std::vector<CornerTriangle> cut_ears(std::span<const glm::dvec3> corners);

}  // namespace sunfleck

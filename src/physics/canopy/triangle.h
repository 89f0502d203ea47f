#pragma once
// A triangle of the canopy and what follows from its corners alone.

#include <array>
#include <glm/vec3.hpp>

namespace sunfleck {

using Triangle = std::array<glm::vec3, 3>;  // corners, m, counter-clockwise seen from the upper face

// Returns the one-sided area, m2, in double precision.
[[nodiscard]] double area_m2(const Triangle& triangle);

// Returns the unit normal of the upper face; zero for a triangle without area.
[[nodiscard]] glm::dvec3 unit_normal(const Triangle& triangle);

}  // namespace sunfleck

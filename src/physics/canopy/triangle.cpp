#include "physics/canopy/triangle.h"

#include <glm/geometric.hpp>

namespace sunfleck {

double area_m2(const Triangle& triangle) {
  const glm::dvec3 a(triangle[0]);
  return 0.5 * glm::length(glm::cross(glm::dvec3(triangle[1]) - a, glm::dvec3(triangle[2]) - a));
}

glm::dvec3 unit_normal(const Triangle& triangle) {
  const glm::dvec3 a(triangle[0]);
  const glm::dvec3 cross = glm::cross(glm::dvec3(triangle[1]) - a, glm::dvec3(triangle[2]) - a);
  const double length = glm::length(cross);
  return length > 0.0 ? cross / length : glm::dvec3(0.0);
}

}  // namespace sunfleck

#include "physics/canopy/mesh.h"

#include <cmath>

namespace sunfleck {

// Clockwise as seen from above means that south (+X) turns towards west (+Z).
glm::dvec3 placed_m(const glm::dvec3& vertex_m, const Placement& placement) {
  const glm::dvec3 scaled_m = vertex_m * placement.scale;
  if (placement.heading_rad == 0.0) return scaled_m + placement.position_m;
  const double c = std::cos(placement.heading_rad);
  const double s = std::sin(placement.heading_rad);
  return glm::dvec3(scaled_m.x * c - scaled_m.z * s, scaled_m.y, scaled_m.x * s + scaled_m.z * c) + placement.position_m;
}

}  // namespace sunfleck

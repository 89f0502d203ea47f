#include "physics/transport/model/exposure.h"

#include "base/in_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

// Smallest cosine between an element's plane and the beam that corners in single precision can resolve.
constexpr double least_cosine = 1e-5;

// Returns true if the whole element lies below the soil plane, at the depth where tracers place it.
bool is_below(const shared::GroundMap& ground, const Triangle& corners) {
  const float floor_m = ground.y - ground.depth;
  return std::all_of(corners.begin(), corners.end(), [&](const glm::vec3& corner) { return corner.y < floor_m; });
}

// Returns true if the beam could reach the element only through an isolated plot's rectangle of soil. The rectangle is
// convex, so testing the corners is enough.
bool is_shaded_by_soil(const shared::GroundMap& ground, const Triangle& corners, const glm::dvec3& to_sun) {
  return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) {
    const glm::dvec3 at_ground = corner + to_sun * ((double{ground.y} - corner.y) / to_sun.y);
    return at_ground.x >= ground.plot_lo.x && at_ground.x <= ground.plot_hi.x && at_ground.z >= ground.plot_lo.y &&
           at_ground.z <= ground.plot_hi.y;
  });
}

}  // namespace

BeamExposure::BeamExposure(const RadiationModel& model, const CounterLayout& layout, double ground_per_ray_m2)
    : lit_m2_per_landing_(model.canopy.size()) {
  if (!model.has_beam()) return;
  const glm::dvec3 to_sun = direction_to_sun(*model.sun);
  const std::vector<bool> copied = copied_elements(model.canopy.copies, model.canopy.size());
  const shared::GroundMap ground = make_ground_map(layout);
  constexpr std::size_t elements_per_block = 16384;
  each_in_blocks(model.canopy.size(), elements_per_block, [&](std::size_t e) {
    const Triangle& corners = model.canopy.corners[e];
    const double cosine = std::abs(glm::dot(unit_normal(corners), to_sun));
    if (cosine <= least_cosine || copied[e]) return;
    const bool below = model.soil && is_below(ground, corners);
    if (below && (model.plot.periodic || is_shaded_by_soil(ground, corners, to_sun))) return;
    lit_m2_per_landing_[e] = static_cast<float>(ground_per_ray_m2 * to_sun.y / cosine);
  });
}

double unseen_sunlit_m2(std::vector<FacingArea> parts, double landings) {
  std::sort(parts.begin(), parts.end(),
            [](const FacingArea& a, const FacingArea& b) { return a.lit_m2_per_landing > b.lit_m2_per_landing; });
  double unseen_m2 = 0.0;
  for (const FacingArea& part : parts) {
    const double hidden_m2 = std::min(part.area_m2, landings * part.lit_m2_per_landing);
    unseen_m2 += hidden_m2;
    landings -= hidden_m2 / part.lit_m2_per_landing;
    if (landings <= 0.0) break;
  }
  return unseen_m2;
}

std::vector<bool> hidden_elements(const RadiationModel& model, const CounterLayout& layout) {
  std::vector<bool> hidden = copied_elements(model.canopy.copies, model.canopy.size());
  if (!model.soil || !model.plot.periodic) return hidden;
  const shared::GroundMap ground = make_ground_map(layout);
  for (std::size_t e = 0; e < hidden.size(); ++e) {
    if (is_below(ground, model.canopy.corners[e])) hidden[e] = true;
  }
  return hidden;
}

}  // namespace sunfleck

#include "physics/transport/model/stand_aim.h"

#include "physics/transport/model/surfaces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

// A stand is aimed at if the sphere around the scene is wider than its own by at least this factor.
constexpr double least_reach = 3.0;

}  // namespace

std::optional<StandAim> make_stand_aim(const RadiationModel& model, const CounterLayout& layout) {
  if (model.plot.periodic || !model.planes.empty()) return std::nullopt;
  const Surfaces surfaces(model);
  StandAim aim;
  aim.lo_m = glm::dvec3(1e300);
  aim.hi_m = glm::dvec3(-1e300);
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    if (surfaces.at(e).soil()) continue;
    const Triangle corners = model.canopy.corners[e];
    for (const glm::vec3& corner : corners) {
      aim.lo_m = glm::min(aim.lo_m, glm::dvec3(corner));
      aim.hi_m = glm::max(aim.hi_m, glm::dvec3(corner));
    }
  }
  if (!(aim.lo_m.x <= aim.hi_m.x)) return std::nullopt;
  aim.centre_m = 0.5 * (aim.lo_m + aim.hi_m);
  // The radii are enlarged by 2^-16, so that rounding to single precision leaves nothing outside.
  aim.radius_m = 0.5 * glm::length(aim.hi_m - aim.lo_m) * (1.0 + 0x1p-16);
  const glm::dvec3 farthest_m = glm::max(glm::abs(layout.box.lo_m - aim.centre_m), glm::abs(layout.box.hi_m - aim.centre_m));
  aim.reach_m = glm::length(farthest_m) * (1.0 + 0x1p-16);
  if (!(aim.radius_m > 0.0) || aim.reach_m < least_reach * aim.radius_m) return std::nullopt;
  return aim;
}

}  // namespace sunfleck

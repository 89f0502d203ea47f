#include "pictures/charts/open_spot.h"

#include <algorithm>
#include <glm/gtx/norm.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace sunfleck {
namespace {

constexpr int spots_a_side = 17;  // odd, so that the middle is one of them
constexpr float clear_m = 0.1F;

bool is_open(const Canopy& canopy, const glm::vec3& spot_m) {
  return std::none_of(canopy.corners.begin(), canopy.corners.end(), [&](const Triangle& corners) {
    const auto is_near = [&](const glm::vec3& point) { return glm::distance2(point, spot_m) < clear_m * clear_m; };
    return is_near((corners[0] + corners[1] + corners[2]) / 3.0F) || std::any_of(corners.begin(), corners.end(), is_near);
  });
}

}  // namespace

glm::dvec3 open_spot(const RadiationModel& model, double height_m) {
  const glm::dvec2 size_m(model.plot.size_x_m, model.plot.size_z_m);
  const glm::dvec2 middle_m = 0.5 * size_m;
  std::vector<glm::dvec2> spots_m;
  for (int k = 0; k < spots_a_side * spots_a_side; ++k) {
    const glm::dvec2 cell(k % spots_a_side, k / spots_a_side);
    spots_m.push_back(size_m * (cell + 0.5) / double{spots_a_side});
  }
  std::stable_sort(spots_m.begin(), spots_m.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
    return glm::distance2(a, middle_m) < glm::distance2(b, middle_m);
  });
  for (const glm::dvec2& spot : spots_m) {
    const glm::dvec3 at_m(spot.x, height_m, spot.y);
    if (is_open(model.canopy, glm::vec3(at_m - model.canopy.origin_m))) return at_m;
  }
  return {middle_m.x, height_m, middle_m.y};
}

}  // namespace sunfleck

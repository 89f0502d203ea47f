#include "physics/light/beam_grid.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sunfleck {
namespace {

void choose_cells(BeamGrid& grid, double rays) {
  const double length_u_m = glm::length(grid.edge_u_m);
  const double length_v_m = glm::length(grid.edge_v_m);
  const double most = static_cast<double>(max_grid_rays);
  const double wanted = std::clamp(rays, 1.0, most);
  const double columns = std::clamp(std::round(std::sqrt(wanted * length_u_m / length_v_m)), 1.0, wanted);
  grid.columns = static_cast<std::uint32_t>(columns);
  grid.rows = static_cast<std::uint32_t>(std::clamp(std::round(wanted / columns), 1.0, most / columns));
}

}  // namespace

BeamGrid endless_beam_grid(glm::dvec2 period_m, double top_m, glm::dvec3 to_sun, double rays) {
  EXPECT(to_sun.y, >, 0.0);
  BeamGrid grid;
  grid.corner_m = {0.0, top_m, 0.0};
  grid.edge_u_m = {period_m.x, 0.0, 0.0};
  grid.edge_v_m = {0.0, 0.0, period_m.y};
  grid.direction = -to_sun;
  grid.horizontal_area_m2 = period_m.x * period_m.y;
  choose_cells(grid, rays);
  return grid;
}

BeamGrid isolated_beam_grid(glm::dvec3 lo_m, glm::dvec3 hi_m, glm::dvec3 to_sun, double rays) {
  EXPECT(to_sun.y, >, 0.0);
  const glm::dvec3 level = std::abs(to_sun.x) < std::abs(to_sun.z) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(glm::cross(to_sun, level));
  const glm::dvec3 v = glm::cross(to_sun, u);
  glm::dvec3 lo(1e300);
  glm::dvec3 hi(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at_m((corner & 1) != 0 ? hi_m.x : lo_m.x, (corner & 2) != 0 ? hi_m.y : lo_m.y,
                          (corner & 4) != 0 ? hi_m.z : lo_m.z);
    const glm::dvec3 in_beam(glm::dot(at_m, u), glm::dot(at_m, v), glm::dot(at_m, to_sun));
    lo = glm::min(lo, in_beam);
    hi = glm::max(hi, in_beam);
  }
  // The rectangle is enlarged by 2^-16 of its size, so that rounding to single precision leaves nothing outside.
  const double margin_m = std::ldexp(glm::length(hi - lo), -16);
  lo -= margin_m;
  hi += margin_m;
  BeamGrid grid;
  grid.corner_m = u * lo.x + v * lo.y + to_sun * hi.z;
  grid.edge_u_m = u * (hi.x - lo.x);
  grid.edge_v_m = v * (hi.y - lo.y);
  grid.direction = -to_sun;
  grid.horizontal_area_m2 = (hi.x - lo.x) * (hi.y - lo.y) / to_sun.y;
  choose_cells(grid, rays);
  return grid;
}

}  // namespace sunfleck

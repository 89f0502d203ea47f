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

// All grids around a stand together represent at most about half as many rays as a counter holds.
constexpr double most_represented_rays = 0x1p30;
// The aimed grid is at least this part of the scene's shadow wide and high, even before a single leaf seen edge-on.
constexpr double least_aimed_part = 0x1p-10;

// A box as the beam sees it: x and y across the beam, z against it.
struct Shadow {
  glm::dvec3 lo{1e300}, hi{-1e300};

  // Returns 2^-16 of its size: if it is enlarged by this, rounding to single precision leaves nothing outside.
  [[nodiscard]] double margin_m() const { return std::ldexp(glm::length(hi - lo), -16); }
  [[nodiscard]] double area_m2() const { return (hi.x - lo.x) * (hi.y - lo.y); }
  void widen(double by_m) {
    lo -= by_m;
    hi += by_m;
  }
};

// The axes of a beam.
struct BeamFrame {
  explicit BeamFrame(glm::dvec3 towards_sun) : to_sun(towards_sun) {
    const glm::dvec3 level = std::abs(to_sun.x) < std::abs(to_sun.z) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    u = glm::normalize(glm::cross(to_sun, level));
    v = glm::cross(to_sun, u);
  }

  [[nodiscard]] Shadow shadow(const BeamBox& box) const {
    Shadow shadow;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at_m((corner & 1) != 0 ? box.hi_m.x : box.lo_m.x, (corner & 2) != 0 ? box.hi_m.y : box.lo_m.y,
                            (corner & 4) != 0 ? box.hi_m.z : box.lo_m.z);
      const glm::dvec3 in_beam(glm::dot(at_m, u), glm::dot(at_m, v), glm::dot(at_m, to_sun));
      shadow.lo = glm::min(shadow.lo, in_beam);
      shadow.hi = glm::max(shadow.hi, in_beam);
    }
    return shadow;
  }

  // Returns the rectangle from `lo` to `hi`, without cells, at a distance of `top_m` towards the sun.
  [[nodiscard]] BeamGrid grid(const glm::dvec3& lo, const glm::dvec3& hi, double top_m) const {
    BeamGrid grid;
    grid.corner_m = u * lo.x + v * lo.y + to_sun * top_m;
    grid.edge_u_m = u * (hi.x - lo.x);
    grid.edge_v_m = v * (hi.y - lo.y);
    grid.direction = -to_sun;
    grid.horizontal_area_m2 = (hi.x - lo.x) * (hi.y - lo.y) / to_sun.y;
    return grid;
  }

  glm::dvec3 to_sun, u{0.0}, v{0.0};
};

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

BeamGrid isolated_beam_grid(const BeamBox& box, glm::dvec3 to_sun, double rays) {
  EXPECT(to_sun.y, >, 0.0);
  const BeamFrame frame(to_sun);
  Shadow shadow = frame.shadow(box);
  shadow.widen(shadow.margin_m());
  BeamGrid grid = frame.grid(shadow.lo, shadow.hi, shadow.hi.z);
  choose_cells(grid, rays);
  return grid;
}

std::vector<WeightedBeamGrid> aimed_beam_grids(const BeamBox& stand, const BeamBox& scene, glm::dvec3 to_sun, double rays) {
  EXPECT(to_sun.y, >, 0.0);
  const BeamFrame frame(to_sun);
  Shadow wide = frame.shadow(scene);
  Shadow aimed = frame.shadow(stand);
  const double margin_m = wide.margin_m();
  wide.widen(margin_m);
  aimed.widen(margin_m);
  const glm::dvec3 missing = glm::max(glm::dvec3(0.0), least_aimed_part * (wide.hi - wide.lo) - (aimed.hi - aimed.lo));
  aimed.lo -= 0.5 * missing;
  aimed.hi += 0.5 * missing;
  const double top_m = wide.hi.z;
  const double ratio = wide.area_m2() / aimed.area_m2();
  WeightedBeamGrid first{frame.grid(aimed.lo, aimed.hi, top_m), 1};
  choose_cells(first.grid, std::min(rays, most_represented_rays / ratio));
  // Cells of the surrounding grids are whole numbers of the first one's cells wide and high, so that their rays represent a whole
  // number of its rays. A grid may reach beyond the scene's shadow by part of a cell.
  const double many = std::max(1.0, std::round(std::sqrt(2.0 * ratio)));
  const double side_rows = std::max(1.0, std::round(first.grid.rows / many));
  const double rows_a_cell = std::max(1.0, std::round(first.grid.rows / side_rows));
  first.grid.rows = static_cast<std::uint32_t>(side_rows * rows_a_cell);
  const double width_m = (aimed.hi.x - aimed.lo.x) / first.grid.columns * many;
  const double height_m = (aimed.hi.y - aimed.lo.y) / first.grid.rows * many;
  const double before = std::ceil(std::max(0.0, aimed.lo.x - wide.lo.x) / width_m);
  const double behind = std::ceil(std::max(0.0, wide.hi.x - aimed.hi.x) / width_m);
  const double below = std::ceil(std::max(0.0, aimed.lo.y - wide.lo.y) / height_m);
  const double above = std::ceil(std::max(0.0, wide.hi.y - aimed.hi.y) / height_m);
  const double across = std::ceil(before + behind + first.grid.columns / many);
  const double left_m = aimed.lo.x - before * width_m;
  std::vector<WeightedBeamGrid> grids{first};
  const auto surround = [&](glm::dvec2 corner, double columns, double rows, double cell_m, double weight) {
    if (columns == 0.0 || rows == 0.0) return;
    const glm::dvec3 lo(corner, 0.0);
    WeightedBeamGrid grid{frame.grid(lo, lo + glm::dvec3(columns * width_m, rows * cell_m, 0.0), top_m),
                          static_cast<std::uint32_t>(weight)};
    grid.grid.columns = static_cast<std::uint32_t>(columns);
    grid.grid.rows = static_cast<std::uint32_t>(rows);
    grids.push_back(grid);
  };
  const double side_cell_m = height_m / many * rows_a_cell;
  surround({left_m, aimed.lo.y}, before, side_rows, side_cell_m, many * rows_a_cell);
  surround({aimed.hi.x, aimed.lo.y}, behind, side_rows, side_cell_m, many * rows_a_cell);
  surround({left_m, aimed.lo.y - below * height_m}, across, below, height_m, many * many);
  surround({left_m, aimed.hi.y}, across, above, height_m, many * many);
  return grids;
}

}  // namespace sunfleck

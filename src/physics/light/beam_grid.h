#pragma once
// The parallel rays of the sun's beam: a rectangle above the canopy, cut into cells, with one jittered ray per cell.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sunfleck {

// A grid of beam rays. All lengths are in the canopy's local frame. Every ray carries the same flux:
// horizontal beam irradiance * horizontal_area_m2 / rays().
struct BeamGrid {
  glm::dvec3 corner_m{0.0};
  glm::dvec3 edge_u_m{0.0};
  glm::dvec3 edge_v_m{0.0};
  glm::dvec3 direction{0.0, -1.0, 0.0};  // unit vector of travel
  std::uint32_t columns = 1;             // cells along edge u
  std::uint32_t rows = 1;                // cells along edge v
  double horizontal_area_m2 = 0.0;       // level ground that the beam through the rectangle would light

  [[nodiscard]] std::uint64_t rays() const { return std::uint64_t{columns} * rows; }
  // Returns the area of level ground that one ray represents.
  [[nodiscard]] double horizontal_area_per_ray_m2() const { return horizontal_area_m2 / static_cast<double>(rays()); }
};

// The largest number of cells in one grid: ray numbers stay below 2^31.
inline constexpr std::uint64_t max_grid_rays = std::uint64_t{1} << 28U;

// Returns the grid above an endless canopy: one period of the horizontal plane at height `top_m`. `to_sun` is the unit
// vector towards the sun, with a positive y. The grid has about `rays` nearly square cells, at least one.
[[nodiscard]] BeamGrid endless_beam_grid(glm::dvec2 period_m, double top_m, glm::dvec3 to_sun, double rays);

// A box with two opposite corners.
struct BeamBox {
  glm::dvec3 lo_m{0.0}, hi_m{0.0};
};

// Returns the grid before an isolated stand: the rectangle perpendicular to the beam that just covers the shadow of the box.
[[nodiscard]] BeamGrid isolated_beam_grid(const BeamBox& box, glm::dvec3 to_sun, double rays);

// A grid whose rays each carry the flux of `weight` rays of a finer one.
struct WeightedBeamGrid {
  BeamGrid grid;
  std::uint32_t weight = 1;
};

// Returns grids before a small stand on a wide plot. The first one, with weight 1, is the rectangle perpendicular to the beam
// that just covers the shadow of the stand's box, in about `rays` cells. The others surround it without overlap and cover the
// shadow of the scene's box, in about half as many cells. All rays together represent less than 2^31 rays of the first grid,
// which therefore gets fewer than `rays` where the scene is very wide.
[[nodiscard]] std::vector<WeightedBeamGrid> aimed_beam_grids(const BeamBox& stand, const BeamBox& scene, glm::dvec3 to_sun,
                                                             double rays);

}  // namespace sunfleck

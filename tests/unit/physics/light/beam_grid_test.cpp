// Tests the grids of beam rays that surround a small stand.
#include "physics/light/beam_grid.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace sunfleck::test {
namespace {

struct AimedScene {
  BeamBox stand, plot;
  glm::dvec3 to_sun;
};

glm::dvec3 sun_at(double x, double y, double z) {
  return glm::normalize(glm::dvec3(x, y, z));
}

// Stands in the middle, in a corner and on the border of their plots, one of them a single upright leaf seen edge-on.
std::vector<AimedScene> aimed_scenes() {
  return {
      {{{2.9, 0.0, 2.9}, {3.1, 0.1, 3.1}}, {{0.0, 0.0, 0.0}, {6.0, 0.1, 6.0}}, sun_at(0.5, 1.0, 0.2)},
      {{{0.0, 0.0, 0.0}, {0.3, 0.5, 0.2}}, {{0.0, 0.0, 0.0}, {2.0, 0.5, 9.0}}, sun_at(-0.7, 0.1, 0.3)},
      {{{-0.2, 0.0, 4.0}, {0.2, 1.0, 4.4}}, {{-0.2, 0.0, 0.0}, {50.0, 1.0, 50.0}}, sun_at(0.0, 1.0, 0.0)},
      {{{1.0, 0.0, 1.0}, {1.2, 0.2, 1.0}}, {{0.0, 0.0, 0.0}, {4.0, 0.2, 4.0}}, sun_at(1.0, 1.0, 0.0)},
  };
}

// Returns whether the ray through a point crosses the grid's rectangle.
bool covers(const BeamGrid& grid, const glm::dvec3& point_m) {
  const glm::dvec3 from = point_m - grid.corner_m;
  const double u = glm::dot(from, grid.edge_u_m) / glm::dot(grid.edge_u_m, grid.edge_u_m);
  const double v = glm::dot(from, grid.edge_v_m) / glm::dot(grid.edge_v_m, grid.edge_v_m);
  return u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0;
}

glm::dvec3 point_in(const BeamBox& box, std::mt19937& random) {
  const auto unit = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  const glm::dvec3 size_m = box.hi_m - box.lo_m;
  return box.lo_m + glm::dvec3(unit() * size_m.x, unit() * size_m.y, unit() * size_m.z);
}

TEST(AimedBeamGrids, CoverTheSceneWithoutOverlap) {
  std::mt19937 random(1);
  for (const AimedScene& scene : aimed_scenes()) {
    for (const double rays : {1.0, 700.0, 16384.0, 3e6}) {
      const std::vector<WeightedBeamGrid> grids = aimed_beam_grids(scene.stand, scene.plot, scene.to_sun, rays);
      ASSERT_GE(grids.size(), 3U);
      for (int k = 0; k < 2000; ++k) {
        EXPECT_TRUE(covers(grids.front().grid, point_in(scene.stand, random)));
        const glm::dvec3 at_m = point_in(scene.plot, random);
        int covering = 0;
        for (const WeightedBeamGrid& part : grids) covering += covers(part.grid, at_m) ? 1 : 0;
        EXPECT_EQ(covering, 1);
      }
    }
  }
}

TEST(AimedBeamGrids, GiveEachRayTheFluxOfItsWeight) {
  for (const AimedScene& scene : aimed_scenes()) {
    for (const double rays : {1.0, 700.0, 16384.0, 3e6}) {
      const std::vector<WeightedBeamGrid> grids = aimed_beam_grids(scene.stand, scene.plot, scene.to_sun, rays);
      const double unit_m2 = grids.front().grid.horizontal_area_per_ray_m2();
      EXPECT_EQ(grids.front().weight, 1U);
      std::uint64_t represented = 0;
      for (const WeightedBeamGrid& part : grids) {
        EXPECT_NEAR(part.grid.horizontal_area_per_ray_m2() / unit_m2 / part.weight, 1.0, 1e-12);
        EXPECT_EQ(part.grid.direction, -scene.to_sun);
        represented += part.weight * part.grid.rays();
      }
      EXPECT_LT(represented, std::uint64_t{1} << 31U);
    }
  }
}

TEST(AimedBeamGrids, SpendMostRaysOnTheStand) {
  for (const AimedScene& scene : aimed_scenes()) {
    const std::vector<WeightedBeamGrid> grids = aimed_beam_grids(scene.stand, scene.plot, scene.to_sun, 16384.0);
    std::uint64_t around = 0;
    for (std::size_t k = 1; k < grids.size(); ++k) around += grids[k].grid.rays();
    EXPECT_NEAR(static_cast<double>(grids.front().grid.rays()), 16384.0, 2000.0);
    EXPECT_LT(around, grids.front().grid.rays());
  }
}

// Six million times as wide as the stand: no number may overflow, and no grid may be empty.
TEST(AimedBeamGrids, OfASpeckOnAnImmensePlot) {
  const BeamBox stand{{5e5, 0.0, 5e5}, {5e5 + 0.1, 0.1, 5e5 + 0.1}};
  for (const double rays : {1.0, 1e5, 2e8}) {
    std::uint64_t represented = 0;
    for (const WeightedBeamGrid& part :
         aimed_beam_grids(stand, {{0.0, 0.0, 0.0}, {6e5, 0.1, 6e5}}, sun_at(0.3, 1.0, 0.1), rays)) {
      EXPECT_GE(part.grid.rays(), 1U);
      EXPECT_GE(part.weight, 1U);
      represented += part.weight * part.grid.rays();
    }
    EXPECT_LT(represented, std::uint64_t{1} << 32U);
  }
}

}  // namespace
}  // namespace sunfleck::test

// Tests that a fan finds for each of its rays, bit for bit, the hit that the ray finds alone in the tree and by a test of every
// triangle.
#include "devices/tracers/fan_walk.h"

#include "support/bvh_check.h"
#include "support/copies.h"
#include "support/models.h"
#include "support/processor_kinds.h"
#include "support/walks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

using test::far_limit;
using test::many_directions;
using test::tree_of;
using testing_bvh::Random;
using testing_bvh::scattered;
using testing_bvh::uniform;

RayFan fan_of(const std::vector<shared::Ray>& rays, float limit = far_limit) {
  RayFan fan;
  fan.rays = static_cast<std::uint32_t>(rays.size());
  std::copy(rays.begin(), rays.end(), fan.along.begin());
  fan.limits.fill(limit);
  return fan;
}

// Returns the number of hits.
std::size_t expect_hits_of_single_rays(const Bvh& bvh, const RayFan& fan, Images images = Images::all) {
  BundleHits hits;
  CpuHit untouched;
  untouched.element = 4711;
  untouched.t = far_limit;
  hits.fill(untouched);
  nearest_hits(bvh, fan, images, hits);
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < fan.rays; ++k) {
    SCOPED_TRACE("ray " + std::to_string(k));
    test::expect_same_hit(hits[k], nearest_hit(bvh, fan.along[k], fan.limits[k], images));
    if (images == Images::all) test::expect_same_hit(hits[k], nearest_hit_of_all(bvh, fan.along[k], fan.limits[k]));
    found += hits[k].found ? 1 : 0;
  }
  for (std::uint32_t k = fan.rays; k < rays_per_bundle; ++k) EXPECT_EQ(hits[k].element, 4711U);
  return found;
}

// Returns rays from one point, which pass on through a square of 4 x 4 cells at the distance of `forward`.
std::vector<shared::Ray> rays_through(Random& random, const glm::vec3& eye, const glm::vec3& forward, double cell,
                                      std::uint32_t rays) {
  const glm::vec3 upright = std::abs(forward.y) < 0.9F * glm::length(forward) ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 right = glm::normalize(glm::cross(forward, upright));
  const glm::vec3 up = glm::normalize(glm::cross(right, forward));
  std::vector<shared::Ray> result;
  for (std::uint32_t k = 0; k < rays; ++k) {
    const auto across = static_cast<float>(cell * (k % 4 - 2.0 + uniform(random)));
    const std::uint32_t row = k / 4;
    const auto upwards = static_cast<float>(cell * (row - 2.0 + uniform(random)));
    result.push_back(shared::make_ray(eye, forward + across * right + upwards * up));
  }
  return result;
}

TEST(FanWalk, OfEachSizeFindsTheHitsOfSingleRays) {
  Random random(1);
  const Bvh bvh = tree_of(scattered(400, 0.5, 0.15, 2));
  std::size_t found = 0;
  for (std::uint32_t rays = 0; rays <= rays_per_bundle; ++rays) {
    for (const double cell : {0.001, 0.03, 0.4}) {
      const auto fan = fan_of(rays_through(random, {-0.9F, 0.8F, -0.5F}, {0.9F, -0.8F, 0.5F}, cell, rays));
      found += expect_hits_of_single_rays(bvh, fan);
    }
  }
  EXPECT_GT(found, 100U);
}

// Rays about those along axes and diagonals travel into different octants or differ in their longest axis.
TEST(FanWalk, InEachDirectionFindsTheHitsOfSingleRaysOnEachKindOfProcessor) {
  const Bvh bvh = tree_of(scattered(400, 0.5, 0.15, 4));
  test::for_each_processor_kind([&] {
    Random random(3);
    for (const glm::vec3& direction : many_directions) {
      std::size_t found = 0;
      for (const double cell : {0.0, 0.005, 0.05, 0.25}) {
        const glm::vec3 eye = testing_bvh::point(random, 0.2) - direction;
        found += expect_hits_of_single_rays(bvh, fan_of(rays_through(random, eye, direction, cell, rays_per_bundle)));
      }
      EXPECT_GT(found, 10U);
    }
  });
}

TEST(FanWalk, OfScatteredRaysFindsTheHitsOfSingleRays) {
  const Bvh bvh = tree_of(scattered(300, 0.5, 0.2, 6));
  Random random(5);
  std::size_t found = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<shared::Ray> rays;
    for (std::uint32_t k = 0; k < rays_per_bundle; ++k) {
      const glm::vec3 origin = testing_bvh::point(random, 0.7);
      rays.push_back(shared::make_ray(origin, testing_bvh::point(random, 1.0)));
    }
    found += expect_hits_of_single_rays(bvh, fan_of(rays));
  }
  EXPECT_GT(found, 100U);
}

TEST(FanWalk, LooksWithEachRayOnlyAsFarAsItsLimit) {
  Random random(7);
  const Bvh bvh = tree_of(scattered(300, 0.5, 0.3, 8));
  RayFan fan = fan_of(rays_through(random, {0.1F, 0.9F, 0.05F}, {-0.1F, -0.9F, -0.05F}, 0.05, rays_per_bundle));
  BundleHits hits;
  nearest_hits(bvh, fan, Images::all, hits);
  for (std::uint32_t k = 0; k < rays_per_bundle; ++k) {
    ASSERT_TRUE(hits[k].found);
    const float beyond = std::nextafter(hits[k].t, k % 2 == 0 ? 0.0F : far_limit);
    fan.limits[k] = k % 4 < 2 ? hits[k].t : beyond;  // exactly there, just before or just past it
  }
  fan.limits[5] = 0.0F;
  fan.limits[6] = -1.0F;
  EXPECT_EQ(expect_hits_of_single_rays(bvh, fan), 11U);
}

// Rays from one point through corners and edges of a grid of squares, whose triangles are there twice.
TEST(FanWalk, AtEdgesCornersAndDuplicatesFindsTheHitsOfSingleRays) {
  std::vector<Triangle> corners;
  for (int copy = 0; copy < 2; ++copy) {
    for (int x = -4; x < 4; ++x) {
      for (int z = -4; z < 4; ++z) {
        const glm::vec3 at(0.125F * static_cast<float>(x), 0.0F, 0.125F * static_cast<float>(z));
        const glm::vec3 south = at + glm::vec3(0.125F, 0.0F, 0.0F);
        const glm::vec3 west = at + glm::vec3(0.0F, 0.0F, 0.125F);
        const glm::vec3 opposite = south + west - at;
        const bool upwards = (x + z + copy) % 2 == 0;
        corners.push_back(upwards ? Triangle{at, west, south} : Triangle{at, south, west});
        corners.push_back(upwards ? Triangle{opposite, south, west} : Triangle{opposite, west, south});
      }
    }
  }
  const Bvh bvh = tree_of(std::move(corners));
  for (const glm::vec3& eye : {glm::vec3(0.0F, 1.0F, 0.0F), glm::vec3(0.25F, 0.5F, -0.125F), glm::vec3(-2.0F, 1.0F, 1.0F)}) {
    for (const float step : {0.125F, 0.0625F}) {
      std::vector<shared::Ray> rays;
      for (int k = 0; k < 16; ++k) {
        const int row = k / 4;
        const glm::vec3 aim(step * static_cast<float>(row - 2), 0.0F, step * static_cast<float>(k % 4 - 2));
        rays.push_back(shared::make_ray(eye, aim - eye));
      }
      EXPECT_EQ(expect_hits_of_single_rays(bvh, fan_of(rays)), 16U);
    }
  }
}

TEST(FanWalk, WithoutTrianglesFindsNothing) {
  Random random(9);
  const auto fan = fan_of(rays_through(random, {0.0F, 1.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 0.1, rays_per_bundle));
  EXPECT_EQ(expect_hits_of_single_rays(Bvh{}, fan), 0U);
}

// Returns the number of hits of fans in each direction, from outside a plot of a metre.
std::size_t look_at_plot(const Bvh& bvh, Images images) {
  Random random(10);
  std::size_t found = 0;
  for (const glm::vec3& direction : many_directions) {
    const glm::vec3 eye = glm::vec3(0.5F, 0.3F, 0.5F) - direction;
    for (const double cell : {0.01, 0.1}) {
      found += expect_hits_of_single_rays(bvh, fan_of(rays_through(random, eye, direction, cell, rays_per_bundle)), images);
    }
  }
  return found;
}

TEST(FanWalk, AmongCopiesThatShareATreeFindsTheHitsOfSingleRaysOnEachKindOfProcessor) {
  const RadiationModel model = test::stand_of_copies({test::unit_plot, 12, true, 3}, true);
  const test::Prepared prepared(model);
  ASSERT_FALSE(prepared.bvh.copies.empty());
  test::for_each_processor_kind([&] {
    EXPECT_GT(look_at_plot(prepared.bvh, Images::all), 50U);
    EXPECT_GT(look_at_plot(prepared.bvh, Images::originals), 50U);
  });
}

TEST(FanWalk, OfAPeriodicPlotLeavesOutImagesIfAsked) {
  const RadiationModel model =
      black_model(test::random_leaves(300, 0.02, test::unit_plot, 1.0, 5), test::unit_plot, beijing_sun());
  const test::Prepared prepared(model);
  const auto is_image = [](const BvhTriangle& triangle) { return triangle.image != 0; };
  ASSERT_TRUE(std::any_of(prepared.bvh.triangles.begin(), prepared.bvh.triangles.end(), is_image));
  EXPECT_GT(look_at_plot(prepared.bvh, Images::all), 50U);
  EXPECT_GT(look_at_plot(prepared.bvh, Images::originals), 50U);
}

}  // namespace
}  // namespace sunfleck

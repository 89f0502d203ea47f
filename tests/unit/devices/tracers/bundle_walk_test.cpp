// Tests that a bundle finds for each of its rays, bit for bit, the hit that the ray finds alone in the tree and by a test of
// every triangle.
#include "devices/tracers/bundle_walk.h"

#include "support/bvh_check.h"
#include "support/copies.h"
#include "support/models.h"
#include "support/processor_kinds.h"
#include "support/walks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

using test::far_limit;
using test::many_directions;
using test::tree_of;
using testing_bvh::Random;
using testing_bvh::scattered;
using testing_bvh::uniform;

RayBundle bundle_of(const glm::vec3& direction, const std::vector<glm::vec3>& origins, float limit = far_limit) {
  RayBundle bundle;
  bundle.along = shared::make_ray({7.0F, 8.0F, 9.0F}, direction);  // whose origin must have no effect
  bundle.rays = static_cast<std::uint32_t>(origins.size());
  bundle.origins.fill(origins.empty() ? glm::vec3() : origins.front());  // rays that are not there would have hits, too
  std::copy(origins.begin(), origins.end(), bundle.origins.begin());
  bundle.limits.fill(limit);
  return bundle;
}

// Returns the number of hits.
std::size_t expect_hits_of_single_rays(const Bvh& bvh, const RayBundle& bundle) {
  BundleHits hits;
  CpuHit untouched;
  untouched.element = 4711;
  untouched.t = far_limit;
  hits.fill(untouched);
  nearest_hits(bvh, bundle, hits);
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < bundle.rays; ++k) {
    SCOPED_TRACE("ray " + std::to_string(k));
    const shared::Ray ray = shared::make_ray(bundle.origins[k], bundle.along.direction);
    test::expect_same_hit(hits[k], nearest_hit(bvh, ray, bundle.limits[k]));
    test::expect_same_hit(hits[k], nearest_hit_of_all(bvh, ray, bundle.limits[k]));
    found += hits[k].found ? 1 : 0;
  }
  for (std::uint32_t k = bundle.rays; k < rays_per_bundle; ++k) EXPECT_EQ(hits[k].element, 4711U);
  return found;
}

// Returns a place for each ray in a square of 4 x 4 cells.
std::vector<glm::vec3> square_of(Random& random, const glm::vec3& corner, double cell, std::uint32_t rays) {
  std::vector<glm::vec3> origins;
  for (std::uint32_t k = 0; k < rays; ++k) {
    const std::uint32_t row = k / 4;
    const double x = cell * (row + uniform(random));
    const double z = cell * (k % 4 + uniform(random));
    origins.push_back(corner + glm::vec3(x, 0.0, z));
  }
  return origins;
}

TEST(BundleWalk, OfEachSizeFindsTheHitsOfSingleRays) {
  Random random(1);
  const Bvh bvh = tree_of(scattered(400, 0.5, 0.15, 2));
  std::size_t found = 0;
  for (std::uint32_t rays = 1; rays <= rays_per_bundle; ++rays) {
    for (const double cell : {0.001, 0.03, 0.4}) {
      found +=
          expect_hits_of_single_rays(bvh, bundle_of({0.4F, -0.8F, 0.2F}, square_of(random, {-0.6F, 0.8F, -0.4F}, cell, rays)));
    }
  }
  EXPECT_GT(found, 100U);
}

TEST(BundleWalk, InEachDirectionFindsTheHitsOfSingleRays) {
  Random random(3);
  const Bvh bvh = tree_of(scattered(400, 0.5, 0.1, 4));
  for (const glm::vec3& direction : many_directions) {
    std::size_t found = 0;
    for (const double cell : {0.005, 0.05, 0.25}) {
      const glm::vec3 corner = testing_bvh::point(random, 0.3) - direction;
      found += expect_hits_of_single_rays(bvh, bundle_of(direction, square_of(random, corner, cell, rays_per_bundle)));
    }
    EXPECT_GT(found, 10U);
  }
}

// The rays differ along all axes, as after crossing borders, and most start among the triangles.
TEST(BundleWalk, OfScatteredOriginsFindsTheHitsOfSingleRaysOnEachKindOfProcessor) {
  const Bvh bvh = tree_of(scattered(300, 0.5, 0.2, 6));
  test::for_each_processor_kind([&] {
    Random random(5);
    for (const glm::vec3& direction : many_directions) {
      std::vector<glm::vec3> origins;
      for (std::uint32_t k = 0; k < rays_per_bundle; ++k) origins.push_back(testing_bvh::point(random, 0.7));
      EXPECT_GT(expect_hits_of_single_rays(bvh, bundle_of(direction, origins)), 1U);
    }
  });
}

TEST(BundleWalk, LooksWithEachRayOnlyAsFarAsItsLimit) {
  Random random(7);
  const Bvh bvh = tree_of(scattered(300, 0.5, 0.2, 8));
  RayBundle bundle = bundle_of({0.1F, -0.9F, 0.3F}, square_of(random, {-0.3F, 0.8F, -0.3F}, 0.1, rays_per_bundle));
  BundleHits hits;
  nearest_hits(bvh, bundle, hits);
  for (std::uint32_t k = 0; k < rays_per_bundle; ++k) {
    ASSERT_TRUE(hits[k].found);
    const float beyond = std::nextafter(hits[k].t, k % 2 == 0 ? 0.0F : far_limit);
    bundle.limits[k] = k % 4 < 2 ? hits[k].t : beyond;  // exactly there, just before or just past it
  }
  bundle.limits[5] = 0.0F;
  bundle.limits[6] = -1.0F;
  const std::size_t found = expect_hits_of_single_rays(bvh, bundle);
  EXPECT_EQ(found, 11U);
}

// Rays through corners and along edges of a grid of squares, whose triangles are there twice and cross others edge-on.
TEST(BundleWalk, AtEdgesCornersAndDuplicatesFindsTheHitsOfSingleRays) {
  std::vector<Triangle> corners;
  for (int copy = 0; copy < 2; ++copy) {
    for (int x = 0; x < 8; ++x) {
      for (int z = 0; z < 8; ++z) {
        const glm::vec3 at(0.125F * static_cast<float>(x), 0.5F, 0.125F * static_cast<float>(z));
        const glm::vec3 south = at + glm::vec3(0.125F, 0.0F, 0.0F);
        const glm::vec3 west = at + glm::vec3(0.0F, 0.0F, 0.125F);
        const glm::vec3 opposite = south + west - at;
        const bool upwards = (x + z + copy) % 2 == 0;
        corners.push_back(upwards ? Triangle{at, west, south} : Triangle{at, south, west});
        corners.push_back(upwards ? Triangle{opposite, south, west} : Triangle{opposite, west, south});
        corners.push_back({at, south, at + glm::vec3(0.0F, 0.25F, 0.0F)});  // edge-on to rays that travel along y
      }
    }
  }
  const Bvh bvh = tree_of(std::move(corners));
  for (const glm::vec3& direction :
       {glm::vec3(0.0F, -1.0F, 0.0F), glm::vec3(0.125F, -0.25F, 0.125F), glm::vec3(-0.25F, -0.5F, 0.0F)}) {
    for (const float step : {0.125F, 0.0625F}) {
      std::vector<glm::vec3> origins;
      for (int k = 0; k < 16; ++k) {
        const int row = k / 4;
        origins.push_back(glm::vec3(0.25F + step * static_cast<float>(row), 1.0F, 0.25F + step * static_cast<float>(k % 4)) -
                          0.5F * direction);
      }
      EXPECT_EQ(expect_hits_of_single_rays(bvh, bundle_of(direction, origins)), 16U);
    }
  }
}

TEST(BundleWalk, WithoutTrianglesOrRaysFindsNothing) {
  EXPECT_EQ(expect_hits_of_single_rays(Bvh{}, bundle_of({0.0F, -1.0F, 0.0F}, {{0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 0.0F}})), 0U);
  EXPECT_EQ(expect_hits_of_single_rays(tree_of(scattered(20, 0.5, 0.2, 9)), bundle_of({0.0F, -1.0F, 0.0F}, {})), 0U);
}

TEST(BundleWalk, AmongCopiesThatShareATreeFindsTheHitsOfSingleRaysOnEachKindOfProcessor) {
  const RadiationModel model = test::stand_of_copies({test::unit_plot, 12, true, 3}, true);
  const test::Prepared prepared(model);
  ASSERT_FALSE(prepared.bvh.copies.empty());
  test::for_each_processor_kind([&] {
    Random random(10);
    std::size_t found = 0;
    for (const glm::vec3& direction : many_directions) {
      const glm::vec3 corner = glm::vec3(0.3F, 0.4F, 0.3F) - direction;
      found += expect_hits_of_single_rays(prepared.bvh, bundle_of(direction, square_of(random, corner, 0.1, rays_per_bundle)));
    }
    EXPECT_GT(found, 20U);
  });
}

}  // namespace
}  // namespace sunfleck

#pragma once
// Functions shared by the tests of the walks: trees, directions, and a comparison of hits, bit for bit.

#include "devices/tracers/cpu_walk.h"
#include "physics/bvh/build.h"
#include "support/bvh_check.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace sunfleck::test {

inline constexpr float far_limit = 1e30F;

inline const std::vector<glm::vec3> many_directions = {{0.0F, -1.0F, 0.0F},   {0.6F, -0.7F, 0.3F},   {-0.6F, -0.3F, 0.7F},
                                                       {0.3F, -0.01F, -0.9F}, {-0.9F, -0.2F, -0.1F}, {0.0F, -0.6F, 0.8F},
                                                       {1.0F, 0.0F, 0.0F},    {0.0F, 0.0F, -1.0F},   {-0.5F, 0.5F, 0.0F},
                                                       {0.2F, 0.9F, -0.4F},   {1.0F, -1.0F, 1.0F},   {1e-30F, -1.0F, -1e-30F}};

inline Bvh tree_of(std::vector<Triangle> corners) {
  constexpr float padding_m = 1e-5F;
  return build_bvh(testing_bvh::isolated(std::move(corners)), padding_m);
}

inline void expect_same_hit(const CpuHit& got, const CpuHit& expected) {
  EXPECT_EQ(got.found, expected.found);
  EXPECT_EQ(got.t, expected.t);
  EXPECT_EQ(got.weight_b, expected.weight_b);
  EXPECT_EQ(got.weight_c, expected.weight_c);
  EXPECT_EQ(got.lower, expected.lower);
  EXPECT_EQ(got.element, expected.element);
  EXPECT_EQ(got.triangle, expected.triangle);
  EXPECT_EQ(got.reference, expected.reference);
  EXPECT_EQ(got.copy, expected.copy);
}

}  // namespace sunfleck::test

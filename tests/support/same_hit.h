#pragma once
// Compares what two walks of the tree found, bit for bit.

#include "devices/tracers/cpu_walk.h"

#include <gtest/gtest.h>

namespace sunfleck::test {

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

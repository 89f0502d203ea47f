#include "shared/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sunfleck::shared {
namespace {

// Returns the distance from 1 / x in units in the last place of the nearest float.
double units_off(float reciprocal, float x) {
  const double exact = 1.0 / static_cast<double>(x);
  const double unit = std::ldexp(1.0, std::ilogb(static_cast<float>(exact)) - 23);
  return std::abs(static_cast<double>(reciprocal) - exact) / unit;
}

TEST(ExactReciprocal, IsWithinTwoUnitsForEveryFraction) {
  double worst = 0.0;
  for (std::uint32_t fraction = 0; fraction < 1U << 23U; ++fraction) {
    const float x = uintBitsToFloat(0x3f800000U | fraction);
    worst = std::fmax(worst, units_off(exact_reciprocal(x), x));
  }
  EXPECT_LE(worst, 2.0);
}

TEST(ExactReciprocal, IsWithinTwoUnitsForEveryExponentAndSign) {
  double worst = 0.0;
  for (int exponent = -100; exponent < 100; ++exponent) {
    for (std::uint32_t k = 0; k < 5'000; ++k) {
      const float x = std::ldexp(uintBitsToFloat(0x3f800000U | (k * 2654435761U >> 9U)), exponent);
      worst = std::fmax(worst, units_off(exact_reciprocal(x), x));
      EXPECT_EQ(exact_reciprocal(-x), -exact_reciprocal(x));
    }
  }
  EXPECT_LE(worst, 2.0);
}

TEST(DirectionReciprocal, TreatsNearlyZeroAsATinyNumberOfTheSameSign) {
  const float denormal = std::numeric_limits<float>::denorm_min();
  for (const float x : {0.0F, denormal, 1e-38F, 1e-30F, std::nextafter(0x1p-60F, 0.0F)}) {
    EXPECT_EQ(direction_reciprocal(x), 0x1p60F) << x;
    EXPECT_EQ(direction_reciprocal(-x), -0x1p60F) << x;
  }
  EXPECT_LE(units_off(direction_reciprocal(0x1p-60F), 0x1p-60F), 2.0);
}

TEST(DirectionReciprocal, IsTheReciprocalElsewhere) {
  for (const float x : {1e-15F, 0.1F, 0.5F, 1.0F, 3.0F, 1e6F}) {
    EXPECT_EQ(direction_reciprocal(x), exact_reciprocal(x));
    EXPECT_EQ(direction_reciprocal(-x), -exact_reciprocal(x));
  }
}

}  // namespace
}  // namespace sunfleck::shared

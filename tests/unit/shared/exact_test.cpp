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

// Returns the distance from an exact value in units in the last place of the nearest float.
double units_between(float value, double exact) {
  return std::abs(static_cast<double>(value) - exact) / std::ldexp(1.0, std::ilogb(static_cast<float>(exact)) - 23);
}

// Over every exponent and over the fractions of both parities of it, between which roots differ.
TEST(ExactRoot, AndItsInverseAreWithinThreeUnits) {
  double worst_inverse = 0.0;
  double worst = 0.0;
  const auto compare = [&](float x) {
    const double root = std::sqrt(static_cast<double>(x));
    worst_inverse = std::fmax(worst_inverse, units_between(exact_inverse_root(x), 1.0 / root));
    worst = std::fmax(worst, units_between(exact_root(x), root));
  };
  for (std::uint32_t fraction = 0; fraction < 1U << 24U; fraction += 13) compare(uintBitsToFloat(0x3f800000U + fraction));
  for (int exponent = -100; exponent < 100; ++exponent) {
    for (std::uint32_t k = 0; k < 1'000; ++k) {
      compare(std::ldexp(uintBitsToFloat(0x3f800000U | ((k + 1) * 2654435761U >> 9U)), exponent));
    }
  }
  EXPECT_LE(worst_inverse, 3.0);
  EXPECT_LE(worst, 4.0);
}

TEST(ExactRoot, OfWhatIsNotPositiveIsZero) {
  EXPECT_EQ(exact_root(0.0F), 0.0F);
  EXPECT_EQ(exact_root(-0.0F), 0.0F);
  EXPECT_EQ(exact_root(-1.0F), 0.0F);
}

// Weights of a triangle's corners would leave it otherwise.
TEST(ExactRoot, OfTheLargestPartOfTheUnitIntervalIsAtMostOne) {
  for (std::uint32_t units = 1; units < 1'000; ++units) {
    EXPECT_LE(exact_root(1.0F - static_cast<float>(units) * 0x1p-24F), 1.0F) << units;
  }
}

}  // namespace
}  // namespace sunfleck::shared

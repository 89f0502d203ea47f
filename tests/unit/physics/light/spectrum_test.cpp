// Tests the means of spectra over wavebands.
#include "physics/light/spectrum.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

constexpr double rounding = 1e-12;

const Spectrum edge{{400.0, 600.0, 700.0, 800.0}, {0.1, 0.1, 0.5, 0.5}};

TEST(Spectrum, IsLinearBetweenItsValues) {
  EXPECT_EQ(value_at(edge, 400.0), 0.1);
  EXPECT_NEAR(value_at(edge, 650.0), 0.3, rounding);
  EXPECT_EQ(value_at(edge, 700.0), 0.5);
  EXPECT_EQ(value_at(edge, 800.0), 0.5);
}

TEST(Spectrum, CoversARangeToItsEnds) {
  EXPECT_TRUE(covers(edge, {400.0, 800.0}));
  EXPECT_FALSE(covers(edge, {399.9, 700.0}));
  EXPECT_FALSE(covers(edge, {500.0, 800.1}));
}

TEST(Spectrum, HasAMeanOverABand) {
  EXPECT_NEAR(mean_in(edge, {400.0, 600.0}, nullptr), 0.1, rounding);
  EXPECT_NEAR(mean_in(edge, {600.0, 700.0}, nullptr), 0.3, rounding);
  EXPECT_NEAR(mean_in(edge, {500.0, 750.0}, nullptr), (100.0 * 0.1 + 100.0 * 0.3 + 50.0 * 0.5) / 250.0, rounding);
}

// Light that rises linearly from 0 at 600 nm has the weight x: the mean of 0.1 + 0.4 x over 0..1 is (0.05 + 0.4 / 3) / 0.5.
TEST(Spectrum, IsWeightedByTheLight) {
  const Spectrum rising{{500.0, 600.0, 700.0}, {0.0, 0.0, 2.0}};
  EXPECT_NEAR(mean_in(edge, {600.0, 700.0}, &rising), 0.1 + 0.4 * 2.0 / 3.0, rounding);
  EXPECT_NEAR(energy_in(&rising, {550.0, 700.0}), 100.0, 1e-9);
  EXPECT_NEAR(mean_in(edge, {500.0, 550.0}, &rising), 0.1, rounding) << "dark light gives the plain mean";
}

// 4.57 umol J-1 is the usual figure for daylight; light of equal energy from 400 to 700 nm has the photons of 550 nm.
TEST(Spectrum, GivesPhotonsPerEnergy) {
  EXPECT_NEAR(umol_per_joule_in({400.0, 700.0}, nullptr), 550e-9 / 0.119626565 * 1e6, 1e-6);
  const Spectrum red{{400.0, 659.9, 660.0, 660.1, 700.0}, {0.0, 0.0, 1.0, 0.0, 0.0}};
  EXPECT_NEAR(umol_per_joule_in({400.0, 700.0}, &red), 660e-9 / 0.119626565 * 1e6, 1e-6);
}

// A quarter of the radiation lies below wavelength * temperature = 2897.8 um K, the maximum by wavelength (0.25006 from
// tables), and half of it below 4107 um K.
TEST(Spectrum, ABlackBodyHasKnownShares) {
  EXPECT_NEAR(black_body_share({1.0, 2897.77}, 1000.0), 0.25005, 2e-5);
  EXPECT_NEAR(black_body_share({1.0, 4107.0}, 1000.0), 0.5, 1e-4);
  EXPECT_NEAR(black_body_share({1.0, 1e6}, 5772.0), 1.0, 1e-6);
  EXPECT_NEAR(black_body_share({400.0, 700.0}, 5772.0) + black_body_share({700.0, 2500.0}, 5772.0),
              black_body_share({400.0, 2500.0}, 5772.0), rounding);
}

}  // namespace
}  // namespace sunfleck::test

#include "pictures/drawing/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

const Colour grey = {0.5, 0.5, 0.5};
const Colour green = {0.1, 0.5, 0.0};

// Computed by hand. Two lit grey surfaces of equal area have 100 and 400 W m-2: their log-mean is sqrt(100 * 400) = 200,
// whatever lies in the dark. The ratios are 0.5 and 2, the luminances 0.25 and 1. All but 0.5 % of the area is no brighter than
// 1: Lwhite = 1.25, Lwhite^2 = 1.5625. Eq. 4 gives 1 * (1 + 1 / 1.5625) / 2 = 0.82 and 0.25 * (1 + 0.25 / 1.5625) / 1.25 =
// 0.232. As sRGB these are 1.055 * 0.82^(1/2.4) - 0.055 = 0.91628, or 233.7 of 255, and 1.055 * 0.232^(1/2.4) - 0.055 =
// 0.51898, or 132.3.
TEST(ToneMap, OfTwoGreySurfacesIsAsByHand) {
  const ToneMap map =
      make_tone_map(std::vector<double>{100.0, 400.0, 0.0}, std::vector<double>{1.0, 1.0, 5.0}, std::vector<Colour>(3, grey));
  EXPECT_NEAR(map.log_mean_w_m2, 200.0, 1e-10);
  EXPECT_NEAR(map.white, 1.25, 1e-12);
  const Colour bright = hue_colour(map, grey, 400.0);
  const Colour dim = hue_colour(map, grey, 100.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(bright[i], 0.82, 1e-12);
    EXPECT_NEAR(dim[i], 0.232, 1e-12);
  }
  EXPECT_EQ(to_srgb(bright), (std::array<std::uint8_t, 3>{234, 234, 234}));
  EXPECT_EQ(to_srgb(dim), (std::array<std::uint8_t, 3>{132, 132, 132}));
  EXPECT_EQ(hue_colour(map, grey, 0.0), (Colour{}));
}

TEST(ToneMap, WeighsSurfacesByArea) {
  const std::vector<double> irradiance = {10.0, 1000.0};
  const std::vector<Colour> colours(2, grey);
  EXPECT_NEAR(make_tone_map(irradiance, std::vector<double>{3.0, 1.0}, colours).log_mean_w_m2, std::pow(10.0, 1.5), 1e-10);
  EXPECT_NEAR(make_tone_map(irradiance, std::vector<double>{0.0, 1.0}, colours).log_mean_w_m2, 1000.0, 1e-10);
}

TEST(ToneMap, KeepsTheRatiosOfAColour) {
  const ToneMap map{50.0, 2.0};
  for (const double irradiance : {0.5, 50.0, 500.0}) {
    const Colour colour = hue_colour(map, green, irradiance);
    EXPECT_NEAR(colour[0] / colour[1], green[0] / green[1], 1e-12);
    EXPECT_EQ(colour[2], 0.0);
  }
}

// Middle grey: eq. 2's key, 0.18, is the luminance of a card of reflectance 0.18 under the log-mean irradiance. Where white is
// far away, eq. 4 becomes eq. 3: 0.18 / 1.18.
TEST(ToneMap, TakesMiddleGreyFromTheLogMean) {
  const Colour card = {0.18, 0.18, 0.18};
  EXPECT_NEAR(hue_colour({77.0, 1e9}, card, 77.0)[0], 0.18 / 1.18, 1e-12);
}

TEST(ToneMap, GrowsWithIrradiance) {
  const ToneMap map{20.0, 3.0};
  double last = 0.0;
  for (double irradiance = 1.0; irradiance < 2000.0; irradiance *= 1.5) {
    const double y = luminance(hue_colour(map, green, irradiance));
    EXPECT_GT(y, last);
    last = y;
  }
}

TEST(ToneMap, OfTheDarkIsBlack) {
  const std::vector<double> none(2, 0.0);
  const ToneMap map = make_tone_map(none, std::vector<double>(2, 1.0), std::vector<Colour>(2, green));
  EXPECT_EQ(map.log_mean_w_m2, 0.0);
  EXPECT_EQ(hue_colour(map, green, 0.0), (Colour{}));
  const ToneMap empty = make_tone_map({}, {}, {});
  EXPECT_EQ(hue_colour(empty, green, 5.0), (Colour{}));
}

TEST(ToneMap, OfBlackSurfacesIsBlack) {
  const ToneMap map = make_tone_map(std::vector<double>{5.0}, std::vector<double>{1.0}, std::vector<Colour>(1));
  EXPECT_EQ(hue_colour(map, {}, 5.0), (Colour{}));
}

}  // namespace
}  // namespace sunfleck

#include "pictures/drawing/text.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace sunfleck::test {
namespace {

constexpr double size_px = 24.0;

Image drawn(std::string_view line, glm::dvec2 baseline_px = {20.0, 50.0}) {
  Image image = white_image(400, 80);
  Typeface().draw(image, line, baseline_px, size_px, {0.0, 0.0, 0.0});
  return image;
}

// Returns the darkness summed over the picture: 1 for a black pixel.
double ink(const Image& image) {
  double sum = 0.0;
  for (const auto& pixel : image.pixels) sum += (255 - pixel[0]) / 255.0;
  return sum;
}

TEST(Typeface, DrawsWithinTheLineItMeasuresAndNowhereElse) {
  const std::string line = "Hxy(qg)W m⁻² ÅÉ";
  const Image image = drawn(line);
  // Bearings of single letters may stick out by a tenth of the size; accented capitals rise to 0.95 of it.
  const double left = 20.0 - 0.1 * size_px, right = 20.0 + Typeface().width_px(line, size_px) + 0.1 * size_px;
  const double top = 50.0 - 0.95 * size_px - 1.0, bottom = 50.0 + 0.24 * size_px + 1.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (x + 1 > left && x < right && y + 1 > top && y < bottom) continue;
      ASSERT_EQ(image.pixels[static_cast<std::size_t>(y) * image.width + x], white_pixel) << x << ", " << y;
    }
  }
  EXPECT_GT(ink(image), 100.0);
}

TEST(Typeface, StandsOnItsBaselineAsHighAsACapital) {
  const Image image = drawn("H");
  int top = image.height, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixels[static_cast<std::size_t>(y) * image.width + x][0] > 128) continue;
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  }
  EXPECT_EQ(bottom, 50);
  EXPECT_NEAR(50 - top, Typeface::cap_height * size_px, 1.0);  // rounded to whole pixels
}

TEST(Typeface, LaysDownTheInkOfItsLetters) {
  EXPECT_GT(ink(drawn("█")), ink(drawn("H")));
  EXPECT_GT(ink(drawn("H")), ink(drawn("-")));
  EXPECT_EQ(ink(drawn(" ")), 0.0);
  EXPECT_EQ(ink(drawn("")), 0.0);
}

TEST(Typeface, MeasuresInProportionToSize) {
  const Typeface face;
  const double unit = face.width_px("Direct PAR irradiance", 1.0);
  EXPECT_NEAR(face.width_px("Direct PAR irradiance", 24.0), 24.0 * unit, 1e-4 * unit);  // the scale is single precision
  EXPECT_EQ(face.width_px("", 24.0), 0.0);
}

TEST(Typeface, Kerns) {
  const Typeface face;
  EXPECT_LT(face.width_px("AV", 100.0), face.width_px("A", 100.0) + face.width_px("V", 100.0) - 1.0);
}

TEST(Typeface, SetsDigitsInColumns) {
  const Typeface face;
  for (const std::string_view digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    EXPECT_EQ(face.width_px(digit, 24.0), face.width_px("0", 24.0));
  }
}

TEST(Typeface, HasTheSignsOfUnits) {
  const Image missing = drawn("\uE123");  // a private-use character, which has no glyph
  EXPECT_GT(ink(missing), 0.0);
  for (const std::string_view sign : {"⁻", "²", "¹", "·", "°", "–", "—", "−", "×", "µ", "α", "≤", "±"}) {
    EXPECT_GT(ink(drawn(sign)), 0.0) << sign;
    EXPECT_NE(drawn(sign).pixels, missing.pixels) << sign;
  }
}

TEST(Typeface, ReadsUtf8AndReplacesWhatIsNone) {
  const Typeface face;
  const double replaced = face.width_px("\uFFFD", 24.0);
  for (const std::string_view broken :
       {"\x80", "\xff", "\xc3", "\xe2\x81", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf0\x9f"}) {
    const double width = face.width_px(broken, 24.0);
    EXPECT_GE(width, replaced);
    EXPECT_NEAR(std::remainder(width, replaced), 0.0, 1e-9);
    EXPECT_EQ(drawn(std::string(broken) + "A").pixels == drawn("A").pixels, false);
  }
  // A broken start does not swallow the letter that follows it.
  EXPECT_EQ(face.width_px("\xe2|", 24.0), face.width_px("\uFFFD|", 24.0));
  EXPECT_EQ(drawn("\U0001D7D8").pixels == drawn("\uE123").pixels, false);  // four bytes: double-struck zero
}

TEST(Typeface, IsCutOffAtThePicturesEdges) {
  for (const glm::dvec2 at : {glm::dvec2(-30.0, 40.0), glm::dvec2(390.0, 40.0), glm::dvec2(10.0, 5.0), glm::dvec2(10.0, 85.0),
                              glm::dvec2(-1e4, -1e4), glm::dvec2(1e4, 1e4)}) {
    EXPECT_EQ(drawn("Sunfleck", at).pixels.size(), 400U * 80U);
  }
  EXPECT_EQ(ink(drawn("Sunfleck", {1e4, 1e4})), 0.0);
}

TEST(Typeface, DrawsInTheColourGiven) {
  Image image = white_image(60, 60);
  const Colour colour = from_srgb({200, 30, 40});
  Typeface().draw(image, "█", {10.0, 50.0}, 40.0, colour);
  EXPECT_EQ(image.pixels[30U * 60U + 20U], (std::array<std::uint8_t, 3>{200, 30, 40}));
}

}  // namespace
}  // namespace sunfleck::test

#include "pictures/drawing/overlay.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

constexpr Pixel red = {220, 20, 30};

// Returns light of `red` over white in the given share.
Pixel mixed(double share) {
  Colour colour = from_srgb(red);
  for (double& channel : colour) channel = 1.0 + share * (channel - 1.0);
  return to_srgb(colour);
}

TEST(Blend, MixesLight) {
  Pixel pixel = white_pixel;
  blend(pixel, {from_srgb(red), 0.5}, 0.5);
  EXPECT_EQ(pixel, mixed(0.25));
  blend(pixel, {from_srgb(red)}, 0.0);
  EXPECT_EQ(pixel, mixed(0.25));
  blend(pixel, {from_srgb(red)}, 1.0);
  EXPECT_EQ(pixel, red);
}

TEST(FillRectangle, FillsWholePixelsWhollyAndHalvesByHalf) {
  Image image = white_image(20, 10);
  fill_rectangle(image, {{2.0, 3.0}, {6.5, 7.0}}, {}, {from_srgb(red)});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool row_inside = y >= 3 && y < 7;
      const Pixel expected = row_inside && x >= 2 && x < 6 ? red : row_inside && x == 6 ? mixed(0.5) : white_pixel;
      EXPECT_EQ(pixel_at(image, x, y), expected) << x << ", " << y;
    }
  }
}

TEST(FillRectangle, RoundsCorners) {
  Image image = white_image(20, 10);
  fill_rectangle(image, {{2.0, 1.0}, {12.0, 9.0}}, {3.0}, {from_srgb(red)});
  EXPECT_EQ(pixel_at(image, 2, 1), white_pixel);  // 0.54 px beyond the arc
  EXPECT_EQ(pixel_at(image, 11, 8), white_pixel);
  EXPECT_EQ(pixel_at(image, 7, 1), red);
  EXPECT_EQ(pixel_at(image, 2, 5), red);
}

TEST(FillRectangle, IsCutOffAtThePicturesEdges) {
  Image image = white_image(20, 10);
  fill_rectangle(image, {{-5.0, -5.0}, {50.0, 50.0}}, {}, {from_srgb(red)});
  EXPECT_EQ(image.pixels, std::vector<Pixel>(200, red));
  fill_rectangle(image, {{30.0, 30.0}, {50.0, 50.0}}, {}, {from_srgb(white_pixel)});
  EXPECT_EQ(image.pixels, std::vector<Pixel>(200, red));
}

TEST(FillTriangle, CoversPixelsByTheDistanceOfTheirMiddleFromTheEdges) {
  for (const FlatTriangle& corners :
       {FlatTriangle{{{2.0, 2.0}, {12.0, 2.0}, {2.0, 9.0}}}, {{{2.0, 2.0}, {2.0, 9.0}, {12.0, 2.0}}}}) {
    Image image = white_image(20, 10);
    fill_triangle(image, corners, {from_srgb(red)});
    EXPECT_EQ(pixel_at(image, 3, 3), red);
    EXPECT_EQ(pixel_at(image, 1, 3), white_pixel);
    EXPECT_EQ(pixel_at(image, 11, 8), white_pixel);
    EXPECT_EQ(triangle_coverage(corners, {5.0, 2.0}), 0.5);
  }
}

TEST(DrawFlatLine, HasItsWidthAndRoundEnds) {
  Image image = white_image(20, 10);
  draw_flat_line(image, {4.0, 5.0}, {14.0, 5.0}, 4.0, {from_srgb(red)});
  EXPECT_EQ(pixel_at(image, 8, 3), red);
  EXPECT_EQ(pixel_at(image, 8, 6), red);
  EXPECT_EQ(pixel_at(image, 8, 2), white_pixel);
  EXPECT_EQ(pixel_at(image, 3, 5), red) << "the round end";
  EXPECT_EQ(pixel_at(image, 1, 3), white_pixel) << "beside it";
}

TEST(OutlineRectangle, LeavesTheMiddleAlone) {
  Image image = white_image(20, 10);
  outline_rectangle(image, {{2.0, 2.0}, {12.0, 8.0}}, {}, 1.0, {from_srgb(red)});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool in = x >= 2 && x < 12 && y >= 2 && y < 8;
      const bool middle = x >= 3 && x < 11 && y >= 3 && y < 7;
      EXPECT_EQ(pixel_at(image, x, y), in && !middle ? red : white_pixel) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace sunfleck::test

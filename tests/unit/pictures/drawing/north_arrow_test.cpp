#include "pictures/drawing/north_arrow.h"

#include "pictures/drawing/chart.h"
#include "support/box_views.h"
#include "support/chart_scenes.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace sunfleck::test {
namespace {

constexpr glm::dvec3 box_hi(1.8, 2.2, 2.4);
const glm::dvec3 middle_m(0.9, 0.0, 1.2);

// Returns the arrow of a camera in the middle of a white picture of 201 x 201 pixels.
Image arrow_of(const Camera& camera) {
  Image image = white_image(201, 201);
  const Typeface face;
  draw_north_arrow(image, face, camera, middle_m, {{100.5, 100.5}, 100.0});
  return image;
}

int dark_pixels(const Image& image, int left, int top, int right, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) count += pixel_at(image, x, y)[0] < 100 ? 1 : 0;
  }
  return count;
}

TEST(ApparentNorth, IsUpInPlansAndEndOnFromTheSouth) {
  const glm::dvec2 in_plan = apparent_north(top_view(glm::dvec3(0.0), box_hi, 1.0), middle_m);
  EXPECT_LT(glm::distance(in_plan, glm::dvec2(0.0, 1.0)), 1e-12);
  const glm::dvec2 from_south = apparent_north(side_view(glm::dvec3(0.0), box_hi, 1.0), middle_m);
  EXPECT_LT(glm::length(from_south), 1e-12);
}

TEST(ApparentNorth, RunsAlongTheLinesOfThePictureInPerspective) {
  const Camera camera = look_at({3.0, 1.5, 3.5}, {0.75, 0.25, 1.0}, 0.7, 4.0 / 3.0);
  for (const glm::dvec3& from_m : {glm::dvec3(0.9, 0.0, 1.2), {0.4, 0.0, 1.5}, {1.2, 0.3, 0.6}}) {
    const auto from = project(camera, from_m);
    const auto to = project(camera, from_m + glm::dvec3(-1e-5, 0.0, 0.0));
    ASSERT_TRUE(from && to);
    const glm::dvec2 seen = glm::normalize((to->at - from->at) * glm::dvec2(camera.aspect, -1.0));
    EXPECT_LT(glm::distance(glm::normalize(apparent_north(camera, from_m)), seen), 1e-4);
  }
}

TEST(NorthArrow, PointsToItsLetter) {
  const Image plan = arrow_of(top_view(glm::dvec3(0.0), box_hi, 1.0));
  EXPECT_GT(dark_pixels(plan, 70, 0, 131, 45), 100) << "N above";
  EXPECT_EQ(dark_pixels(plan, 0, 0, 60, 201), 0);
  EXPECT_EQ(dark_pixels(plan, 141, 0, 201, 201), 0);
  // Looking down with west above, as in the mirror of a quarter turn, north is to the right.
  Camera turned = top_view(glm::dvec3(0.0), box_hi, 1.0);
  turned.right = {-1.0, 0.0, 0.0};
  turned.up = {0.0, 0.0, 1.0};
  const Image aside = arrow_of(turned);
  EXPECT_GT(dark_pixels(aside, 156, 70, 201, 131), 100);
  EXPECT_EQ(dark_pixels(aside, 0, 0, 201, 60), 0);
}

TEST(NorthArrow, IsARingWithACrossOrADotWhenSeenEndOn) {
  const Camera from_south = side_view(glm::dvec3(0.0), box_hi, 1.0);
  const Image ahead = arrow_of(from_south);
  EXPECT_LT(pixel_at(ahead, 100, 100)[0], 100) << "the middle of the cross";
  EXPECT_LT(pixel_at(ahead, 110, 110)[0], 100) << "an arm of the cross";
  Camera from_north = from_south;
  from_north.forward = -from_south.forward;
  from_north.right = -from_south.right;
  const Image behind = arrow_of(from_north);
  EXPECT_LT(pixel_at(behind, 100, 100)[0], 100) << "the dot";
  EXPECT_GT(pixel_at(behind, 113, 113)[0], 200) << "between dot and ring";
}

TEST(NorthArrow, IsLeftOutWhereItWouldBeIllegible) {
  const Typeface face;
  Image image = white_image(40, 40);
  draw_north_arrow(image, face, top_view(glm::dvec3(0.0), box_hi, 1.0), middle_m, {{20.0, 20.0}, 10.0});
  EXPECT_EQ(image.pixels, white_image(40, 40).pixels);
  const Image round = arrow_of(fisheye_view(middle_m, 1.0));
  EXPECT_EQ(round.pixels, white_image(201, 201).pixels) << "a fisheye has the points of the compass";
}

// The chart's corner has the arrow, and the axes are those of the plot.
TEST(NorthArrow, StandsInTheLowerRightCornerOfCharts) {
  const auto chart = [](Axes axes) {
    Plot plot = chart_plot;
    plot.axes = axes;
    return draw_chart(empty_scene(800, 600), {}, top_view(glm::dvec3(0.0), box_hi, 4.0 / 3.0, axes), plot, chart_height_m, {});
  };
  const Image south = chart(Axes::south_up_west);
  const Image east = chart(Axes::east_north_up);
  for (const Image& image : {south, east}) EXPECT_GT(dark_pixels(image, 700, 480, 790, 570), 60);
  // In the plan, X (red) runs down from the upper right corner, or to the right from the lower left one.
  const auto reds_in_rows = [](const Image& image) {
    int most = 0;
    for (int y = 0; y < image.height; ++y) {
      int reds = 0;
      for (int x = 0; x < image.width; ++x) {
        const Pixel& pixel = pixel_at(image, x, y);
        reds += pixel[0] > 150 && pixel[1] < 120 && pixel[2] < 120 ? 1 : 0;
      }
      most = std::max(most, reds);
    }
    return most;
  };
  EXPECT_GT(reds_in_rows(east), 200);
  EXPECT_LT(reds_in_rows(south), 30);
}

}  // namespace
}  // namespace sunfleck::test

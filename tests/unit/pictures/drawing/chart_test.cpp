#include "pictures/drawing/chart.h"
#include "support/box_views.h"
#include "support/chart_scenes.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

namespace sunfleck::test {
namespace {

constexpr int full_width = 1600, full_height = 1200;
const std::vector<Colour> leaf_colours = {rank_colour(2), rank_colour(4)};

Camera quarter_view() {
  return three_quarter_view({0.0, 0.0, 0.0}, {chart_plot.size_x_m, chart_height_m, chart_plot.size_z_m}, 4.0 / 3.0);
}

// Returns a view that shows nothing of the plot, so that a chart consists of surfaces alone.
Camera averted_view() {
  return look_at({0.0, 50.0, 0.0}, {0.0, 100.0, 1.0}, 0.5, 4.0 / 3.0);
}

// Returns the pixel that shows a point.
Pixel pixel_showing(const Image& image, const Camera& camera, glm::dvec3 point_m) {
  const auto projection = project(camera, point_m);
  return pixel_at(image, static_cast<int>(projection->at.x * image.width), static_cast<int>(projection->at.y * image.height));
}

bool mostly(const Pixel& pixel, std::size_t channel) {
  bool most = true;
  for (std::size_t i = 0; i < 3; ++i) most = most && (i == channel || pixel[channel] >= pixel[i] + 80);
  return most;
}

bool pale(const Pixel& pixel) {
  return std::min({pixel[0], pixel[1], pixel[2]}) > 225;
}

Image bare_chart(const SurfaceImage& seen, const Camera& camera = quarter_view()) {
  return draw_chart(seen, leaf_colours, camera, chart_plot, chart_height_m, {});
}

TEST(DrawChart, ShowsSurfacesInExactlyTheirColours) {
  SurfaceImage seen = empty_scene(160, 120, 4);
  const auto fill = [&](int left, int top, std::uint32_t surface) {
    for (int y = top; y < top + 40; ++y) {
      for (int x = left; x < left + 40; ++x) {
        for (int s = 0; s < 4; ++s) seen.surface[(static_cast<std::size_t>(y) * 160 + x) * 4 + s] = surface;
      }
    }
  };
  fill(20, 30, 0);
  fill(90, 30, 1);
  const Image image = bare_chart(seen, averted_view());
  ASSERT_EQ(image.width, 160);
  ASSERT_EQ(image.height, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const bool row = y >= 30 && y < 70;
      if (row && x >= 20 && x < 60) {
        ASSERT_EQ(pixel_at(image, x, y), to_srgb(leaf_colours[0]));
      } else if (row && x >= 90 && x < 130) {
        ASSERT_EQ(pixel_at(image, x, y), to_srgb(leaf_colours[1]));
      } else {
        ASSERT_TRUE(pale(pixel_at(image, x, y)));
        ASSERT_EQ(pixel_at(image, x, y), pixel_at(image, 0, y));  // the background changes only from top to bottom
      }
    }
  }
}

TEST(DrawChart, AveragesTheLightOfAPixelsSamples) {
  SurfaceImage seen = empty_scene(4, 4, 4);
  const std::array<std::uint32_t, 4> samples = {0, 1, 1, 1};
  std::copy(samples.begin(), samples.end(), seen.surface.begin());
  Colour mean{};
  for (std::size_t i = 0; i < 3; ++i) mean[i] = 0.25 * leaf_colours[0][i] + 0.75 * leaf_colours[1][i];
  EXPECT_EQ(pixel_at(bare_chart(seen, averted_view()), 0, 0), to_srgb(mean));
}

TEST(DrawChart, DrawsTheAxesInRedGreenAndBlue) {
  const Camera camera = quarter_view();
  const Image image = bare_chart(empty_scene(full_width, full_height));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.5 * chart_plot.size_x_m, 0.0, 0.0}), 0));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.0, 0.5 * chart_height_m, 0.0}), 1));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.0, 0.0, 0.5 * chart_plot.size_z_m}), 2));
  // This point lies beyond the plot, where the arrow heads are.
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {1.04 * chart_plot.size_x_m, 0.0, 0.0}), 0));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.0, 0.0, 1.04 * chart_plot.size_z_m}), 2));
}

TEST(DrawChart, DrawsThePlotsBorderInBlack) {
  const Camera camera = quarter_view();
  const Image image = bare_chart(empty_scene(full_width, full_height));
  EXPECT_EQ(pixel_showing(image, camera, {chart_plot.size_x_m, 0.0, 0.3 * chart_plot.size_z_m}), (Pixel{0, 0, 0}));
  EXPECT_EQ(pixel_showing(image, camera, {0.3 * chart_plot.size_x_m, 0.0, chart_plot.size_z_m}), (Pixel{0, 0, 0}));
}

const std::vector<glm::dvec3> line_points = {{0.5 * chart_plot.size_x_m, 0.0, 0.0},
                                             {0.0, 0.5 * chart_height_m, 0.0},
                                             {0.0, 0.0, 0.5 * chart_plot.size_z_m},
                                             {chart_plot.size_x_m, 0.0, 0.3 * chart_plot.size_z_m},
                                             {0.3 * chart_plot.size_x_m, 0.0, chart_plot.size_z_m}};

TEST(DrawChart, HidesLinesBehindSurfaces) {
  const Camera camera = quarter_view();
  SurfaceImage seen = empty_scene(full_width, full_height);
  std::fill(seen.surface.begin(), seen.surface.end(), 0);
  const double nearest_m = project(camera, {chart_plot.size_x_m, chart_height_m, chart_plot.size_z_m})->depth_m;
  std::fill(seen.depth_m.begin(), seen.depth_m.end(), static_cast<float>(0.9 * nearest_m));
  const Image hidden = bare_chart(seen);
  std::fill(seen.depth_m.begin(), seen.depth_m.end(), static_cast<float>(10.0 * nearest_m));
  const Image before = bare_chart(seen);
  for (const glm::dvec3& point : line_points) {
    EXPECT_EQ(pixel_showing(hidden, camera, point), to_srgb(leaf_colours[0]));
    EXPECT_NE(pixel_showing(before, camera, point), to_srgb(leaf_colours[0]));
  }
}

TEST(DrawChart, HidesTheShareOfALineThatSamplesSeeHidden) {
  const Camera camera = quarter_view();
  const glm::dvec3 point_m = line_points[3];
  SurfaceImage seen = empty_scene(full_width, full_height, 2);
  std::fill(seen.surface.begin(), seen.surface.end(), 1);
  const double depth_m = project(camera, point_m)->depth_m;
  for (std::size_t i = 0; i < seen.depth_m.size(); ++i) {
    seen.depth_m[i] = static_cast<float>((i % 2 == 0 ? 0.5 : 2.0) * depth_m);
  }
  Colour half = leaf_colours[1];  // the other half is black
  for (double& channel : half) channel *= 0.5;
  const Pixel got = pixel_showing(bare_chart(seen), camera, point_m);
  // The leaf's colour is rounded to 1/255 before the line is mixed in, and once more afterwards.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(got[i] - to_srgb(half)[i]), 1);
}

TEST(DrawChart, LaysLinesOnTheGround) {
  for (const int height : {60, 300, full_height}) {
    const int width = height * 4 / 3;
    const Camera camera = quarter_view();
    SurfaceImage seen = empty_scene(width, height);
    const double pixel = 0.5 / height;  // samples lie anywhere in their pixel
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double shift = ((x + y) % 3 - 1) * pixel;
        const glm::dvec3 ray = ray_direction(camera, {(x + 0.5) / width, (y + 0.5) / height + shift});
        if (ray.y >= 0.0) continue;
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        seen.surface[i] = 0;
        seen.depth_m[i] = static_cast<float>(-camera.position_m.y / ray.y * glm::dot(ray, camera.forward));
      }
    }
    const Image on_ground = bare_chart(seen);
    std::fill(seen.depth_m.begin(), seen.depth_m.end(), endless_m);
    EXPECT_EQ(on_ground.pixels, bare_chart(seen).pixels) << height;
  }
}

ChartText full_text() {
  const RankScale scale{{0.0, 80.0, 160.0, 240.0, 320.0, 438.0}};
  return {
      "Maize, sparse planting", "Sun at 53.0° elevation", {"Direct PAR irradiance, W m⁻²", {}, rank_legend(scale)}, "seed 1"};
}

TEST(DrawChart, PrintsTheLegendInExactlyTheClassColours) {
  const ChartText text = full_text();
  const SurfaceImage seen = empty_scene(full_width, full_height);
  const Image image = draw_chart(seen, leaf_colours, averted_view(), chart_plot, chart_height_m, text);
  for (const LegendEntry& entry : text.legend.entries) {
    const auto count = std::count(image.pixels.begin(), image.pixels.end(), to_srgb(entry.colour));
    EXPECT_GT(count, 1000);  // a swatch measures 49 x 27 pixels, its outline included
  }
}

// Returns the box of the pixels changed by text, [left, right) x [top, bottom).
std::array<int, 4> changed_box(const Image& a, const Image& b) {
  std::array<int, 4> box = {a.width, 0, a.height, 0};
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (pixel_at(a, x, y) == pixel_at(b, x, y)) continue;
      box = {std::min(box[0], x), std::max(box[1], x + 1), std::min(box[2], y), std::max(box[3], y + 1)};
    }
  }
  return box;
}

TEST(DrawChart, KeepsTextOfAnyLengthWithinTheMargins) {
  for (const auto& [width, height] : {std::pair{1600, 1200}, std::pair{600, 1200}, std::pair{400, 300}, std::pair{1500, 300}}) {
    ChartText text = full_text();
    for (int repeat = 0; repeat < 2; ++repeat) {
      const SurfaceImage seen = empty_scene(width, height);
      const Image plain = draw_chart(seen, leaf_colours, averted_view(), chart_plot, chart_height_m, {});
      const Image written = draw_chart(seen, leaf_colours, averted_view(), chart_plot, chart_height_m, text);
      const auto [left, right, top, bottom] = changed_box(plain, written);
      const double halo = 2.0 * std::max(1.0, 0.07 * 0.030 * height);  // around the largest type
      const double margin = 0.035 * height - halo - 2.5;               // allows for bearings and rounding to whole pixels
      EXPECT_GE(left, margin);
      EXPECT_LE(right, width - margin);
      EXPECT_GE(top, margin);
      EXPECT_LE(bottom, height - margin + 0.0175 * 0.24 * height);  // allows for the footer's descenders
      for (std::string* line : {&text.title, &text.subtitle, &text.legend.title, &text.footer}) *line += std::string(200, 'W');
    }
  }
}

TEST(DrawChart, CopesWithTinyPictures) {
  for (const int size : {1, 2, 7, 40}) {
    const Image image =
        draw_chart(empty_scene(size, size, 3), leaf_colours, quarter_view(), chart_plot, chart_height_m, full_text());
    EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(size) * size);
  }
}

TEST(DrawChart, DrawsWhatLiesBeforeACameraWithinTheScene) {
  const Camera camera = look_at({0.9, 0.4, 1.2}, {0.0, 0.3, 0.3}, 0.9, 4.0 / 3.0);  // parts of all lines are behind the camera
  const Image image = bare_chart(empty_scene(full_width, full_height), camera);
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.2, 0.0, 0.0}), 0));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.0, 0.3, 0.0}), 1));
  EXPECT_TRUE(mostly(pixel_showing(image, camera, {0.0, 0.0, 0.2}), 2));
}

TEST(DrawChart, RefusesImagesOfAnotherSize) {
  SurfaceImage seen = empty_scene(10, 10, 2);
  seen.depth_m.pop_back();
  EXPECT_THROW(static_cast<void>(bare_chart(seen)), std::logic_error);
  EXPECT_THROW(static_cast<void>(bare_chart(SurfaceImage{})), std::logic_error);
}

std::vector<std::string> labels(const RankScale& scale) {
  std::vector<std::string> result;
  for (const LegendEntry& entry : rank_legend(scale)) result.push_back(entry.label);
  return result;
}

TEST(RankLegend, NamesTheClassesFromSunToShade) {
  const std::vector<LegendEntry> legend = rank_legend({{0.0, 80.0, 160.4, 240.0, 320.0, 438.1}});
  ASSERT_EQ(legend.size(), 5U);
  EXPECT_EQ(legend.front().label, "320 – 438");
  EXPECT_EQ(legend[3].label, "80 – 160");
  EXPECT_EQ(legend.back().label, "0 – 80");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(legend[i].colour, rank_colour(4 - i));
}

TEST(RankLegend, PrintsAsManyDigitsAsItTakes) {
  EXPECT_EQ(labels({{0.0, 0.001, 0.002, 0.003, 0.004, 0.005}}).front(), "0.00400 – 0.00500");
  EXPECT_EQ(labels({{0.0, 0.2, 0.4, 100.0, 200.0, 300.0}}).back(), "0.0 – 0.2");
  EXPECT_EQ(labels({{0.0, 300.0, 600.0, 900.0, 1200.0, 1500.0}}).front(), "1200 – 1500");
}

TEST(RankLegend, LeavesOutEmptyClasses) {
  EXPECT_EQ(labels({{0.0, 10.0, 10.0, 10.0, 20.0, 20.0}}), (std::vector<std::string>{"20.0", "10.0 – 20.0", "0.0 – 10.0"}));
  EXPECT_EQ(labels({}), (std::vector<std::string>{"0"}));
}

}  // namespace
}  // namespace sunfleck::test

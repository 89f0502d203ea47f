// Tests charts painted band by band, in every projection, with copies of the plot.

#include "pictures/drawing/chart.h"
#include "support/box_views.h"
#include "support/chart_scenes.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace sunfleck::test {
namespace {

const std::vector<Colour> colours = {{0.1, 0.4, 0.1}, {0.6, 0.5, 0.2}, {0.3, 0.2, 0.1}};

// Returns random surfaces and depths, about as far away as the plot, in blobs of 8 x 8 pixels.
SurfaceImage noise(const Camera& camera, int width, int height, int samples) {
  std::mt19937 random(7);
  const std::size_t count = static_cast<std::size_t>(width) * height * samples;
  SurfaceImage seen{width, height, samples, {}, {}, {}, 0};
  const auto middle = project(camera, {0.5 * chart_plot.size_x_m, 1.0, 0.5 * chart_plot.size_z_m});
  const double depth_m = middle ? middle->depth_m : 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    seen.surface.push_back(random() % 4 == 0 ? SurfaceImage::nothing : static_cast<std::uint32_t>(random() % 3));
    seen.depth_m.push_back(static_cast<float>(depth_m * (0.5 + static_cast<double>(random() % 1000) / 1000.0)));
    seen.neighbour.push_back(random() % 3 == 0 ? 1 : 0);
  }
  return seen;
}

SurfaceImage rows_of(const SurfaceImage& whole, RowBand band) {
  SurfaceImage rows{whole.width, band.count, whole.samples, {}, {}, {}, band.first};
  const std::size_t per_row = static_cast<std::size_t>(whole.width) * whole.samples;
  const auto cut = [&](const auto& all, auto& part) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(band.first * per_row);
    part.assign(begin, begin + static_cast<std::ptrdiff_t>(band.count * per_row));
  };
  cut(whole.surface, rows.surface);
  cut(whole.depth_m, rows.depth_m);
  cut(whole.neighbour, rows.neighbour);
  return rows;
}

std::vector<Camera> all_cameras(double aspect) {
  const glm::dvec3 lo(0.0);
  const glm::dvec3 hi(chart_plot.size_x_m, chart_height_m, chart_plot.size_z_m);
  return {three_quarter_view(lo, hi, aspect), top_view(lo, hi, aspect), side_view(lo, hi, aspect),
          fisheye_view({0.9, 0.1, 1.2}, aspect)};
}

ChartText some_text() {
  ChartText text{"Maize", "Sun at 53°", {"Total PAR irradiance, W m⁻²", {}, {{colours[0], "soil"}}}, "1 million rays"};
  text.legend.bar = ColourBar{0.0, 400.0, {{0.1, 0.0, 0.2}, {0.9, 0.8, 0.1}}};
  return text;
}

TEST(ChartCanvas, PaintsTheSameHoweverTheRowsAreCut) {
  constexpr int width = 320, height = 240;
  for (const Camera& camera : all_cameras(4.0 / 3.0)) {
    const SurfaceImage whole = noise(camera, width, height, 3);
    const Image expected = draw_chart(whole, colours, camera, chart_plot, chart_height_m, some_text());
    for (const int rows : {1, 7, 64, 239}) {
      ChartCanvas canvas({width, height, camera, chart_plot, chart_height_m}, colours);
      std::vector<RowBand> bands;
      for (int first = 0; first < height; first += rows) bands.push_back({first, std::min(rows, height - first)});
      std::shuffle(bands.begin(), bands.end(), std::mt19937(3));
      for (const RowBand& band : bands) canvas.paint(rows_of(whole, band));
      EXPECT_EQ(canvas.finish(some_text()).pixels, expected.pixels) << rows;
    }
  }
}

TEST(ChartCanvas, DimsNeighboursHalfwayToTheBackground) {
  const Camera camera = look_at({0.0, 50.0, 0.0}, {0.0, 100.0, 1.0}, 0.5, 1.0);  // no lines are in view
  constexpr int size = 10;
  SurfaceImage seen{size, size, 1, std::vector<std::uint32_t>(100, SurfaceImage::nothing), std::vector<float>(100, 1.0F),
                    {},   0};
  const Image sky = draw_chart(seen, colours, camera, chart_plot, chart_height_m, {});
  seen.surface.assign(100, 1);
  const Image plain = draw_chart(seen, colours, camera, chart_plot, chart_height_m, {});
  seen.neighbour.assign(100, 0);
  EXPECT_EQ(draw_chart(seen, colours, camera, chart_plot, chart_height_m, {}).pixels, plain.pixels);
  seen.neighbour.assign(100, 1);
  const Image dimmed = draw_chart(seen, colours, camera, chart_plot, chart_height_m, {});
  for (std::size_t i = 0; i < 100; ++i) {
    const Colour background = from_srgb(sky.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      Colour half{};
      half[c] = 0.5 * (colours[1][c] + background[c]);
      EXPECT_NEAR(dimmed.pixels[i][c], to_srgb(half)[c], 1.0);  // the background is rounded in one image and not in the other
    }
  }
}

bool is_coloured(const Pixel& pixel) {
  return std::max({pixel[0], pixel[1], pixel[2]}) - std::min({pixel[0], pixel[1], pixel[2]}) > 100;
}

Pixel pixel_in(const Image& image, glm::dvec2 at) {
  return image
      .pixels[static_cast<std::size_t>(at.y * image.height) * image.width + static_cast<std::size_t>(at.x * image.width)];
}

TEST(ChartCanvas, DrawsTheHorizonOfAFisheyeInsteadOfAxes) {
  const Camera camera = fisheye_view({0.9, 0.1, 1.2}, 4.0 / 3.0);
  const Image image = draw_chart(empty_scene(1600, 1200), colours, camera, chart_plot, chart_height_m, {});
  EXPECT_EQ(std::count_if(image.pixels.begin(), image.pixels.end(), is_coloured), 0);
  const double radius = camera.circle_radius + 0.5 * 0.0022;  // in picture heights; the line lies on the circle's outer side
  for (const double angle : {0.1, 0.9, 2.2, 3.0, 4.4, 5.5}) {
    const glm::dvec2 out(std::cos(angle) / camera.aspect, std::sin(angle));
    EXPECT_LT(pixel_in(image, camera.circle_centre + radius * out)[0], 130);
    EXPECT_GT(pixel_in(image, camera.circle_centre + (radius - 0.01) * out)[0], 225);
    EXPECT_GT(pixel_in(image, camera.circle_centre + (radius + 0.01) * out)[0], 225);
  }
}

TEST(ChartCanvas, DrawsAxesInOrthographicPictures) {
  const auto mostly = [](const Pixel& pixel, std::size_t channel) {
    bool most = true;
    for (std::size_t i = 0; i < 3; ++i) most = most && (i == channel || pixel[channel] >= pixel[i] + 80);
    return most;
  };
  const std::vector<Camera> cameras = all_cameras(4.0 / 3.0);
  const Image top = draw_chart(empty_scene(1600, 1200), colours, cameras[1], chart_plot, chart_height_m, {});
  EXPECT_TRUE(mostly(pixel_in(top, project(cameras[1], {0.9, 0.0, 0.0})->at), 0));
  EXPECT_TRUE(mostly(pixel_in(top, project(cameras[1], {0.0, 0.0, 1.2})->at), 2));
  EXPECT_EQ(pixel_in(top, project(cameras[1], {0.9, 0.0, 2.4})->at), (Pixel{0, 0, 0}));
  const Image side = draw_chart(empty_scene(1600, 1200), colours, cameras[2], chart_plot, chart_height_m, {});
  EXPECT_TRUE(mostly(pixel_in(side, project(cameras[2], {0.0, 1.1, 0.0})->at), 1));
  EXPECT_TRUE(mostly(pixel_in(side, project(cameras[2], {0.0, 0.0, 1.2})->at), 2));
}

TEST(ChartCanvas, HidesLinesInOrthographicPicturesByDepth) {
  const Camera camera = all_cameras(4.0 / 3.0)[1];
  const auto point = project(camera, {0.9, 0.0, 2.4});  // lies on the border
  SurfaceImage seen = empty_scene(1600, 1200);
  seen.surface.assign(seen.surface.size(), 1);
  seen.depth_m.assign(seen.depth_m.size(), static_cast<float>(point->depth_m - 0.5));
  EXPECT_EQ(pixel_in(draw_chart(seen, colours, camera, chart_plot, chart_height_m, {}), point->at), to_srgb(colours[1]));
  seen.depth_m.assign(seen.depth_m.size(), static_cast<float>(point->depth_m));
  EXPECT_EQ(pixel_in(draw_chart(seen, colours, camera, chart_plot, chart_height_m, {}), point->at)[1], 0);
}

TEST(ChartCanvas, RefusesRowsOutsideThePicture) {
  const Camera camera = all_cameras(1.0)[0];
  ChartCanvas canvas({10, 10, camera, chart_plot, chart_height_m}, colours);
  SurfaceImage seen = empty_scene(10, 5);
  seen.first_row = 6;
  EXPECT_THROW(canvas.paint(seen), std::logic_error);
  EXPECT_THROW(canvas.paint(empty_scene(9, 10)), std::logic_error);
}

TEST(RowBands, CoverThePictureInBoundedPieces) {
  constexpr std::int64_t most = 1 << 16;
  for (const auto& [width, height, samples] : {std::array{8192, 8192, 64}, std::array{1600, 1200, 16},
                                               std::array{1600, 1200, 4}, std::array{5000, 37, 4}, std::array{3, 5, 1}}) {
    int next = 0;
    for (const RowBand& band : row_bands(width, height, samples, most)) {
      EXPECT_EQ(band.first, next);
      EXPECT_GT(band.count, 0);
      EXPECT_TRUE(band.count == 1 || static_cast<std::int64_t>(band.count) * width * samples <= most);
      next += band.count;
      EXPECT_TRUE(next == height || band.count == 1 || band.count == 2 || band.count % 4 == 0) << band.count;
    }
    EXPECT_EQ(next, height);
  }
}

}  // namespace
}  // namespace sunfleck::test

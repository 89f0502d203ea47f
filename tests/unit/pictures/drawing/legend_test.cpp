#include "pictures/drawing/legend.h"
#include "support/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

std::vector<std::string> labels(double lo, double hi) {
  std::vector<std::string> result;
  for (const Tick& tick : round_ticks(lo, hi)) result.push_back(tick.label);
  return result;
}

using Labels = std::vector<std::string>;

TEST(RankLegend, OfAnOpenScaleHasNoUpperBoundAtItsTop) {
  const std::vector<LegendEntry> legend = rank_legend({{0.0, 80.0, 160.0, 240.0, 320.0, 438.0}, true});
  ASSERT_EQ(legend.size(), 5U);
  EXPECT_EQ(legend[0].label, "≥ 320");
  EXPECT_EQ(legend[1].label, "240 – 320");
}

TEST(RoundTicks, AreRoundNumbers) {
  EXPECT_EQ(labels(0.0, 438.0), (Labels{"0", "100", "200", "300", "400"}));
  EXPECT_EQ(labels(0.0, 100.0), (Labels{"0", "20", "40", "60", "80", "100"}));
  EXPECT_EQ(labels(0.0, 0.7), (Labels{"0.0", "0.2", "0.4", "0.6"}));
  EXPECT_EQ(labels(-1.0, 1.0), (Labels{"-1.0", "-0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(labels(0.0, 2e9).front(), "0");
  EXPECT_EQ(labels(0.0, 2e9).back(), "2e+09");
  EXPECT_EQ(labels(0.0, 1e-12).back(), "1e-12");
}

TEST(RoundTicks, AreAHandfulWithinTheScale) {
  for (double lo = -3.0; lo < 3.0; lo += 0.37) {
    for (double extent = 1e-6; extent < 1e9; extent *= 1.7) {
      const std::vector<Tick> ticks = round_ticks(lo * extent, (lo + 1.0) * extent);
      EXPECT_GE(ticks.size(), 4U);
      EXPECT_LE(ticks.size(), 10U);
      EXPECT_GE(ticks.front().value, lo * extent);
      EXPECT_LE(ticks.back().value, (lo + 1.0) * extent);
      for (std::size_t i = 1; i < ticks.size(); ++i) {
        EXPECT_GT(ticks[i].value, ticks[i - 1].value);
        EXPECT_NE(ticks[i].label, ticks[i - 1].label);
      }
    }
  }
}

TEST(RoundTicks, MarkTheOneValueOfAScaleWithoutExtent) {
  EXPECT_EQ(labels(3.25, 3.25), (Labels{"3.25"}));
  EXPECT_THROW(static_cast<void>(round_ticks(1.0, 0.0)), std::logic_error);
}

constexpr double type_px = 20.0;
const LegendRoom room = {{390.0, 10.0}, 380.0, 380.0};

// The bar is blue from 0 to 1 in the lower half, then red from 0 to 1.
const ColourBar bar = {0.0, 400.0, {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}};

TEST(DrawLegend, PaintsTheBarFromItsFirstColourUpToItsLast) {
  Image image = white_image(400, 400);
  const Typeface face;
  draw_legend(image, face, {"Total PAR irradiance, W m⁻²", bar, {}}, room, type_px);
  // The title is the widest line: the bar begins 0.9 em from the panel's left edge, below two lines of title.
  const double left = 390.0 - type_px * (1.8 + face.width_px("Total PAR irradiance", 1.0));
  const auto column = static_cast<std::size_t>(left + type_px * (0.9 + 0.95));
  const int top = static_cast<int>(std::round(10.0 + type_px * (0.9 + 2 * 1.35 + 0.35)));
  const int height = static_cast<int>(type_px * 11.0);
  const auto at = [&](int row) { return image.pixels[static_cast<std::size_t>(row) * 400 + column]; };
  const auto colour = [&](double share) {
    const double rest = 2.0 * share;
    return to_srgb(rest <= 1.0 ? Colour{0.0, 0.0, rest} : Colour{rest - 1.0, 0.0, 2.0 - rest});
  };
  for (int row = top + 2; row < top + height - 2; ++row) {  // stays within the outline
    EXPECT_EQ(at(row), colour((top + height - row - 0.5) / height)) << row;
  }
}

TEST(DrawLegend, HasATickAtEachRoundNumber) {
  Image image = white_image(400, 400);
  const Typeface face;
  draw_legend(image, face, {"", bar, {}}, room, type_px);
  // Without a title the bar begins 0.9 em below the panel's edge; the ticks are right of it.
  const double width = type_px * (1.8 + 1.9 + 0.7 + face.width_px("400", 1.0));
  const double end_x = std::round(390.0 - width + type_px * 0.9) + type_px * 1.9;
  const auto column = static_cast<std::size_t>(end_x) + 2;
  const double top = std::round(10.0 + type_px * 0.9);
  for (int k = 0; k <= 4; ++k) {
    const double y = top + type_px * 11.0 * (1.0 - k / 4.0);
    int darkest = 255;
    for (int row = static_cast<int>(y) - 1; row <= static_cast<int>(y); ++row) {
      darkest = std::min<int>(darkest, image.pixels[static_cast<std::size_t>(row) * 400 + column][0]);
    }
    EXPECT_LT(darkest, 200) << k;
    EXPECT_GT(image.pixels[static_cast<std::size_t>(y - 10.0) * 400 + column][0], 240) << k;
  }
}

TEST(DrawLegend, HasEntriesAboveTheBar) {
  const Colour green{0.0, 0.6, 0.1};
  Image image = white_image(400, 400);
  draw_legend(image, Typeface(), {"", bar, {{green, "> 400"}}}, room, type_px);
  int last_row = 0;
  int count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (image.pixels[i] != to_srgb(green)) continue;
    last_row = std::max(last_row, static_cast<int>(i / 400));
    ++count;
  }
  EXPECT_LT(last_row, 10 + type_px * (0.9 + 1.65));
  EXPECT_GT(count, 500);  // of 38 x 21 pixels, outline included
}

TEST(DrawLegend, KeepsToItsRoom) {
  for (const double size_px : {5.0, 20.0, 80.0}) {
    for (const LegendRoom& tight : {LegendRoom{{300.0, 50.0}, 100.0, 300.0}, LegendRoom{{300.0, 50.0}, 280.0, 90.0}}) {
      Image image = white_image(400, 400);
      draw_legend(image, Typeface(), {"Absorbed PAR, W m⁻²", bar, {{Colour{}, "0 – 10"}}}, tight, size_px);
      for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 400; ++x) {
          const bool inside = x >= 300 - tight.width_px - 1 && x <= 301 && y >= 49 && y <= 51 + tight.height_px;
          if (inside) continue;
          ASSERT_EQ(image.pixels[static_cast<std::size_t>(y) * 400 + x], (Pixel{255, 255, 255})) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(DrawLegend, IsNothingWithoutContent) {
  Image image = white_image(400, 400);
  draw_legend(image, Typeface(), {"Title", {}, {}}, room, type_px);
  EXPECT_EQ(image.pixels, white_image(400, 400).pixels);
}

}  // namespace
}  // namespace sunfleck::test

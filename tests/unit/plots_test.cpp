#include "io/day_plot.h"
#include "io/plane_plot.h"
#include "io/profile_plot.h"
#include "support/gnuplot.h"
#include "support/small_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace sunfleck {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr test::Picture::Pixel blue{0x00, 0x72, 0xB2}, vermilion{0xD5, 0x5E, 0x00}, green{0x00, 0x9E, 0x73}, black{0, 0, 0},
    white{255, 255, 255};
const std::string hostile = "it's `touch x` \"@x\" {a}_b^2 \\ \xff";

using Plots = test::GnuplotTest;

ProfileTable profile(double ground_ratio) {
  ProfileTable table{"", 0.95, {"PAR"}, {}};
  for (int i = 0; i <= 20; ++i) {
    const double height_m = 0.1 * i;
    const double ratio = ground_ratio + (1.0 - ground_ratio) * height_m / 2.0;
    table.rows.push_back({height_m, {ratio, 0.03}, {{10.0 + i, 2.0}}});
  }
  table.rows.back().absorbed.clear();
  return table;
}

TEST_F(Plots, AProfileAlone) {
  const test::Picture picture = draw(profile_plot(hostile, {{hostile, profile(0.2)}}, "PAR"));
  EXPECT_EQ(picture.width, 1600);
  EXPECT_EQ(picture.height, 1000);
  EXPECT_GT(picture.count(blue), 1000U);
  EXPECT_EQ(picture.count(vermilion), 0U);
  EXPECT_GT(picture.count(white), 1'000'000U);
}

TEST_F(Plots, TwoProfilesAndFieldData) {
  const MeasuredProfile field{hostile, {{0.0, 0.2}, {1.0, 0.7}, {3.0, 1.0}}};
  const std::vector<ProfileCurve> curves{{"sparse", profile(0.2)}, {hostile, profile(0.02)}};
  const std::string script = profile_plot("Two", curves, "PAR", field);
  EXPECT_NE(script.find("n 3, R2 0.9"), std::string::npos);
  const test::Picture picture = draw(script);
  EXPECT_GT(picture.count(blue), 1000U);
  EXPECT_GT(picture.count(vermilion), 1000U);
  EXPECT_GT(picture.count(black), draw(profile_plot("Two", curves, "PAR")).count(black)) << "rings of the field data";
}

TEST_F(Plots, ProfilesOfAnythingASimulationGives) {
  ProfileTable dark = profile(0.2);
  for (ProfileTable::Row& row : dark.rows) row.sunfleck_ratio = {none, none};
  ProfileTable unsure = profile(0.2);
  for (ProfileTable::Row& row : unsure.rows) {
    row.sunfleck_ratio.half_width = none;
    for (Estimate& absorbed : row.absorbed) absorbed = {0.0, none};
  }
  ProfileTable flat{"", {}, {"PAR"}, {{0.0, {1.0, 0.0}, {{0.0, 0.0}}}, {0.0, {1.0, 0.0}, {}}}};
  std::vector<ProfileCurve> many;
  for (int i = 0; i < 9; ++i) many.push_back({"curve", profile(0.1 * i)});
  const MeasuredProfile field{"field.csv", {{1.0, 0.7}}};
  for (const std::vector<ProfileCurve>& curves :
       {std::vector<ProfileCurve>{{"a", dark}}, {{"a", unsure}}, {{"a", flat}}, {{"a", dark}, {"b", unsure}}, many}) {
    EXPECT_EQ(draw(profile_plot("Any", curves, "PAR", field)).width, 1600);
    EXPECT_EQ(draw(profile_plot("Any", curves, "UV")).width, 1600);
  }
}

// Finds where a plane's first map is drawn: the bounds of its shaded cells.
struct Map {
  int left = 0, top = 0, right = 0, bottom = 0;
};

Map first_map(const test::Picture& picture) {
  constexpr test::Picture::Pixel dark{0x44, 0x01, 0x54};  // the lower end of viridis, which a cell in the shade has
  Map map{picture.width, picture.height, 0, 0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < 760; ++x) {
      if (picture.at(x, y) != dark) continue;
      map.left = std::min(map.left, x);
      map.top = std::min(map.top, y);
      map.right = std::max(map.right, x);
      map.bottom = std::max(map.bottom, y);
    }
  }
  return map;
}

TEST_F(Plots, AMapHasNorthUpAndWestLeft) {
  const auto [model, result] = test::small_plane();
  const test::Picture picture = draw(plane_plot(hostile, model, result, 0, 0));
  EXPECT_EQ(picture.width, 1600);
  const Map map = first_map(picture);
  const double width = map.right - map.left + 1.0, height = map.bottom - map.top + 1.0;
  EXPECT_NEAR(width / height, 3.0, 0.05) << "3 m from east to west, 1 m from north to south";
  const auto at = [&](double from_west, double from_north) {
    return picture.at(map.left + static_cast<int>(from_west * width), map.top + static_cast<int>(from_north * height));
  };
  const test::Picture::Pixel shade = at(1.0 / 6.0, 0.25), sun = at(5.0 / 6.0, 0.25), half = at(0.5, 0.25);
  EXPECT_EQ(shade, (test::Picture::Pixel{0x44, 0x01, 0x54}));
  EXPECT_GT(sun[1], 0xC0) << "bright: yellow or close to it";
  EXPECT_GT(sun[1], half[1]);
  EXPECT_GT(half[1], shade[1]);
  EXPECT_EQ(at(0.5, 0.75), shade) << "south of it";
  EXPECT_EQ(at(5.0 / 6.0, 0.75), shade) << "south-east";
}

TEST_F(Plots, MapsOfAnythingASimulationGives) {
  auto [model, result] = test::small_plane();
  result.planes[0].down.clear();
  EXPECT_EQ(draw(plane_plot("No other light", model, result, 0, 1)).width, 1600);
  result.planes[0].reached.assign(6, 0);
  EXPECT_EQ(draw(plane_plot("All shade", model, result, 0, 0)).width, 1600);
  result.planes[0].reached.clear();
  result.planes[0].crossing.clear();
  result.planes[0].sunfleck_ratio = {none, none};
  EXPECT_EQ(draw(plane_plot("No beam", model, result, 0, 0)).width, 1600);
  for (const auto& [x, z] : {std::pair{1U, 1U}, {1U, 5U}, {1700U, 3U}}) {
    PlaneResult& plane = result.planes[0];
    plane.cells_x = x;
    plane.cells_z = z;
    plane.reached.assign(std::size_t{x} * z, 3);
    plane.crossing.assign(std::size_t{x} * z, 3);
    EXPECT_EQ(draw(plane_plot("Few or many cells", model, result, 0, 0)).width, 1600);
  }
  model.plot = {100.0, 1.0, false};
  EXPECT_EQ(draw(plane_plot("A long plot", model, result, 0, 0)).width, 1600);
}

DayPlotRow step(double start_s, double flux_w_m2) {
  return {start_s,
          600.0,
          {flux_w_m2, 0.0},
          {0.7 * flux_w_m2, 0.05 * flux_w_m2},
          {0.2 * flux_w_m2, 0.02 * flux_w_m2},
          {0.1 * flux_w_m2, 0.01 * flux_w_m2},
          {flux_w_m2 > 0.0 ? 0.4 : none, 0.05}};
}

DayPlot days(int count, int from_hour, int to_hour) {
  DayPlot plot{hostile, "PAR"};
  for (int day = 0; day < count; ++day) {
    for (int s = 3600 * from_hour; s < 3600 * to_hour; s += 600) {
      const double hours = (s + 300.0) / 3600.0;
      plot.rows.push_back(step(86400.0 * (11907 + day) + s, std::max(0.0, 400.0 * std::sin((hours - 6.0) / 12.0 * 3.14))));
    }
  }
  return plot;
}

TEST_F(Plots, TheCourseOfADay) {
  const test::Picture picture = draw(day_plot(days(1, 5, 20)));
  EXPECT_EQ(picture.width, 1600);
  EXPECT_EQ(picture.height, 1100);
  EXPECT_GT(picture.count(black), 1000U) << "incident";
  EXPECT_GT(picture.count(green), 500U) << "absorbed by vegetation";
  EXPECT_GT(picture.count(vermilion), 500U) << "soil, and sunlit leaves";
  EXPECT_GT(picture.count(blue), 200U) << "reflected";
  EXPECT_GT(picture.count({0xB2, 0xE2, 0xD5}, 2), 1000U) << "the band of absorbed by vegetation: 0.3 of green on white";
}

TEST_F(Plots, TheCourseOfSeveralDaysNamesTheirDates) {
  const std::string script = day_plot(days(3, 6, 18));
  EXPECT_NE(script.find("%Y-%m-%d"), std::string::npos);
  EXPECT_EQ(draw(script).width, 1600);
  EXPECT_EQ(draw(day_plot(days(200, 10, 11))).width, 1600);
}

TEST_F(Plots, DaysOfAnythingASimulationGives) {
  DayPlot night{"Night", "PAR"};
  night.rows = {step(0.0, 0.0), step(600.0, 0.0)};
  EXPECT_EQ(draw(day_plot(night)).width, 1600);
  DayPlot one{"One step, no errors", "PAR"};
  one.rows = {step(0.0, 100.0)};
  one.rows[0].incident.half_width = one.rows[0].sunlit_leaf_fraction.half_width = none;
  EXPECT_EQ(draw(day_plot(one)).width, 1600);
}

TEST(LocalClock, ReadsTimesAsTheyStandInTables) {
  const double noon_s = 12.0 * 3600.0;
  EXPECT_EQ(local_clock_s("1970-01-02T12:00:00+08:00"), 86400.0 + noon_s);
  EXPECT_EQ(local_clock_s("1970-01-01 12:00"), noon_s);
  EXPECT_EQ(local_clock_s("2002-08-08T10:10:30Z"), 11907.0 * 86400.0 + 10.0 * 3600.0 + 630.0);
  EXPECT_EQ(local_clock_s("1969-12-31T12:00"), noon_s - 86400.0);
  for (const char* bad : {"", "12:00", "2002-02-30T10:00", "2002-8-8T10:00", "2002-08-08T25:00", "2002-08-08T10:61",
                          "2002-08-08X10:00", "2002-08-08T10:00:7", "2002/08/08T10:00"})
    EXPECT_FALSE(local_clock_s(bad)) << bad;
}

TEST_F(Plots, AThousandCellsASideTakeSeconds) {
  auto [model, result] = test::small_plane();
  PlaneResult& plane = result.planes[0];
  plane.cells_x = plane.cells_z = 1000;
  plane.crossing.assign(1'000'000, 4);
  plane.reached.assign(1'000'000, 0);
  for (std::size_t cell = 0; cell < plane.reached.size(); cell += 3) plane.reached[cell] = 4;
  plane.down.clear();
  EXPECT_EQ(draw(plane_plot("Large", model, result, 0, 0)).width, 1600);
}

}  // namespace
}  // namespace sunfleck

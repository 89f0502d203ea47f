#include "physics/transport/receivers/fleck_sizes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunfleck {
namespace {

// Builds a plane of cells from a drawing, with one line for each row of cells along X. All ten rays reach '#', five reach '+',
// four '-', and none '.'; no ray crosses '?'.
PlaneResult plane_of(const std::vector<std::string>& lines) {
  PlaneResult plane;
  plane.cells_x = static_cast<std::uint32_t>(lines.front().size());
  plane.cells_z = static_cast<std::uint32_t>(lines.size());
  for (const std::string& line : lines) {
    for (const char c : line) {
      plane.crossing.push_back(c == '?' ? 0 : 10);
      plane.reached.push_back(c == '#' ? 10 : c == '+' ? 5 : c == '-' ? 4 : 0);
    }
  }
  return plane;
}

// Returns a plot whose cells measure one square centimetre.
Plot plot_of(const PlaneResult& plane, bool periodic) {
  return {0.01 * plane.cells_x, 0.01 * plane.cells_z, periodic};
}

std::vector<double> areas_cm2(const std::vector<std::string>& lines, bool periodic) {
  const PlaneResult plane = plane_of(lines);
  std::vector<double> areas;
  for (const double area_m2 : fleck_sizes(plane, plot_of(plane, periodic)).areas_m2) areas.push_back(1e4 * area_m2);
  return areas;
}

void expect_areas(const std::vector<std::string>& lines, bool periodic, const std::vector<double>& expected) {
  const std::vector<double> got = areas_cm2(lines, periodic);
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], 1e-9);
}

TEST(FleckSizes, CellsJoinAtEdgesNotAtCorners) {
  expect_areas({"##...", "..#..", "..##."}, false, {2, 3});
}

TEST(FleckSizes, ACellIsLitFromHalfOfItsRaysOn) {
  expect_areas({"+-#?#"}, false, {1, 1, 1});
}

TEST(FleckSizes, JoinAcrossTheBorderOfAPeriodicPlotOnly) {
  const std::vector<std::string> corners{"#..#", "....", "#..#"};
  expect_areas(corners, true, {4});
  expect_areas(corners, false, {1, 1, 1, 1});
  expect_areas({"#...", "....", "..#.", "#..#"}, true, {1, 3});
}

TEST(FleckSizes, ShapesThatMeetLateAreOne) {
  expect_areas({"#.#.#", "#.#.#", "#####"}, false, {11});
  expect_areas({"#####", "#...#", "#.#.#", "#...#", "#####"}, false, {1, 16});
  expect_areas({"######", ".....#", "####.#", "#..#.#", "#.##.#", "#....#", "######"}, false, {27});
}

TEST(FleckSizes, OfAPlaneAllInSunOrAllInShade) {
  expect_areas({"##", "##"}, true, {4});
  expect_areas({"#"}, true, {1});
  expect_areas({"..", ".."}, true, {});
  expect_areas({"?"}, true, {});
}

TEST(FleckSizes, AreSortedIntoClasses) {
  // The flecks measure 1, 1, 2, 4 and 5 cm2 in a plane of 40 cm2.
  const PlaneResult plane = plane_of({"#.#.##..", "........", "####....", "........", "#####..."});
  const FleckSizes sizes = fleck_sizes(plane, plot_of(plane, false));
  ASSERT_EQ(sizes.areas_m2.size(), 5U);
  ASSERT_EQ(sizes.classes.size(), 3U);
  const double lower[] = {1e-4, 2e-4, 5e-4}, share[] = {2.0 / 40, 6.0 / 40, 5.0 / 40};
  const std::size_t flecks[] = {2, 2, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(sizes.classes[i].lower_m2, lower[i], 1e-15);
    EXPECT_EQ(sizes.classes[i].flecks, flecks[i]) << i;
    EXPECT_NEAR(sizes.classes[i].area_share, share[i], 1e-12);
  }
  EXPECT_NEAR(sizes.classes[2].upper_m2, 10e-4, 1e-15);
  EXPECT_NEAR(sizes.area_share, 13.0 / 40, 1e-12);
  EXPECT_DOUBLE_EQ(sizes.rays_per_cell, 10.0);
}

TEST(FleckSizes, ClassesFollowTheCellsHoweverSmallOrLarge) {
  const PlaneResult plane = plane_of({"#."});
  for (const double side_m : {1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0}) {
    const FleckSizes sizes = fleck_sizes(plane, {2.0 * side_m, side_m, true});
    ASSERT_EQ(sizes.classes.size(), 1U);
    EXPECT_NEAR(sizes.classes[0].lower_m2, side_m * side_m, 1e-9 * side_m * side_m);
    EXPECT_NEAR(sizes.classes[0].upper_m2, 2.0 * side_m * side_m, 1e-8 * side_m * side_m);
  }
}

TEST(FleckSizes, OfAPlaneWithoutABeam) {
  PlaneResult plane;
  plane.cells_x = 3;
  plane.cells_z = 2;
  const FleckSizes sizes = fleck_sizes(plane, Plot{});
  EXPECT_TRUE(sizes.areas_m2.empty() && sizes.classes.empty());
}

}  // namespace
}  // namespace sunfleck

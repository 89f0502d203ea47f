#include "physics/canopy/axes.h"

#include "physics/light/sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

constexpr Plot eastern{1.5, 2.25, true, Axes::east_north_up};
constexpr double degree_rad = std::numbers::pi / 180.0;

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-15);
}

TEST(AxesOfTheUser, ChangeNothingWhereTheyAreTheScenes) {
  const Plot plot{1.5, 2.25};
  const glm::dvec3 point(0.1, -0.0, 7.3);
  for (const glm::dvec3& same : {scene_position_m(plot, point), user_position_m(plot, point), scene_direction(plot.axes, point),
                                 user_direction(plot.axes, point), y_up_direction(plot.axes, point)}) {
    EXPECT_EQ(same, point);
    EXPECT_TRUE(std::signbit(same.y));
  }
  EXPECT_EQ(along_level_axes(plot.axes, {1.0, 2.0}), glm::dvec2(1.0, 2.0));
}

TEST(EastNorthUp, CountsFromTheSouthWestCorner) {
  EXPECT_EQ(scene_position_m(eastern, {0, 0, 0}), glm::dvec3(1.5, 0.0, 2.25));
  EXPECT_EQ(scene_position_m(eastern, {2.25, 1.5, 0.0}), glm::dvec3(0.0, 0.0, 0.0)) << "the north-east corner";
  EXPECT_EQ(user_position_m(eastern, {0.5, 0.75, 1.0}), glm::dvec3(1.25, 1.0, 0.75));
  EXPECT_EQ(along_level_axes(eastern.axes, {1.5, 2.25}), glm::dvec2(2.25, 1.5));
  const glm::dvec3 corner_m = user_position_m(eastern, {1.5, 0.0, 2.25});
  for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(corner_m[axis])) << "-0 in tables";
}

TEST(EastNorthUp, GoesThereAndBack) {
  for (const glm::dvec3& point : {glm::dvec3(0.25, 0.5, 4.0), {-3.0, 8.5, -1.125}}) {
    EXPECT_EQ(user_position_m(eastern, scene_position_m(eastern, point)), point);
    EXPECT_EQ(user_direction(eastern.axes, scene_direction(eastern.axes, point)), point);
    EXPECT_EQ(scene_direction_of_y_up(eastern.axes, y_up_direction(eastern.axes, point)), point);
    EXPECT_EQ(scene_position_m(eastern, point) - scene_position_m(eastern, {0, 0, 0}), scene_direction(eastern.axes, point));
  }
}

TEST(EastNorthUp, IsATurnWithoutAReflection) {
  const glm::dvec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
  for (const auto turned : {scene_direction, scene_direction_of_y_up}) {
    EXPECT_EQ(glm::cross(turned(eastern.axes, a), turned(eastern.axes, b)), turned(eastern.axes, c));
  }
}

// The sun's azimuth says where north and east are in the scene.
TEST(EastNorthUp, AgreesWithAzimuths) {
  const auto level_direction = [](double azimuth_deg) {
    return user_direction(eastern.axes, direction_to_sun({.elevation_rad = 0.0, .azimuth_rad = azimuth_deg * degree_rad}));
  };
  expect_near(level_direction(0.0), {0, 1, 0});
  expect_near(level_direction(90.0), {1, 0, 0});
  expect_near(user_direction(eastern.axes, direction_to_sun({.elevation_rad = 90.0 * degree_rad, .azimuth_rad = 0.0})),
              {0, 0, 1});
  for (int axis = 0; axis < 2; ++axis) EXPECT_STREQ(axis_direction(eastern.axes, axis), axis == 0 ? "east" : "north");
  EXPECT_EQ(up_axis(eastern.axes), 2);
}

// x east, y up, z south, as glTF's importers turn z-up scenes.
TEST(EastNorthUp, PutsNorthBehindInFilesWithYUp) {
  const glm::dvec3 north = scene_direction(eastern.axes, {0, 1, 0});
  EXPECT_EQ(y_up_direction(eastern.axes, north), glm::dvec3(0, 0, -1));
}

}  // namespace
}  // namespace sunfleck

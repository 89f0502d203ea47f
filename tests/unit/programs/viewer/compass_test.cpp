#include "programs/viewer/compass.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sunfleck {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

void expect_near(glm::dvec2 place, double x, double y) {
  EXPECT_NEAR(place.x, x, 1e-9);
  EXPECT_NEAR(place.y, y, 1e-9);
}

TEST(Compass, HasNorthWhereTheCameraSeesIt) {
  const Camera top = top_view({0, 0, 0}, {1, 1, 1}, 1.0);
  expect_near(place_on_compass(top, 0.0, 0.0), 0.0, 1.0);
  expect_near(place_on_compass(top, quarter, 0.0), 1.0, 0.0);
  const Camera upwards = fisheye_view({0.5, 0.0, 0.5}, 1.0);  // east is left
  expect_near(place_on_compass(upwards, 0.0, 0.0), 0.0, 1.0);
  expect_near(place_on_compass(upwards, quarter, 0.0), -1.0, 0.0);
  const Camera westwards = look_at({0.5, 1.0, -2.0}, {0.5, 0.0, 0.5}, 0.7, 1.0);  // from the east, west is ahead
  expect_near(place_on_compass(westwards, 3 * quarter, 0.0), 0.0, 1.0);
  expect_near(place_on_compass(westwards, 0.0, 0.0), 1.0, 0.0);
}

TEST(Compass, HasTheZenithInTheMiddle) {
  const Camera top = top_view({0, 0, 0}, {1, 1, 1}, 1.0);
  expect_near(place_on_compass(top, quarter, quarter), 0.0, 0.0);
  expect_near(place_on_compass(top, quarter, 0.5 * quarter), 0.5, 0.0);
}

}  // namespace
}  // namespace sunfleck

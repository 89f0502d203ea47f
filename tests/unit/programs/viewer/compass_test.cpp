#include "programs/viewer/compass.h"

#include "pictures/drawing/chart.h"
#include "support/box_views.h"

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

TEST(Compass, CoversTheNorthArrowAndNoText) {
  for (const glm::vec2 size : {glm::vec2(1600, 1200), glm::vec2(256, 480), glm::vec2(400, 1000), glm::vec2(3000, 500)}) {
    constexpr float left_px = 300.0F;
    const CompassPlace compass = compass_place(left_px, size.x, size.y);
    const NorthArrowPlace arrow = north_arrow_place(size.x, size.y);
    EXPECT_NEAR(compass.centre_px.x, left_px + arrow.centre_px.x, 0.01);
    EXPECT_NEAR(compass.centre_px.y, arrow.centre_px.y, 0.01);
    EXPECT_GT(compass.reach_px, 1.1 * arrow.radius_px);
    EXPECT_LT(compass.centre_px.x + compass.reach_px, left_px + size.x);
    EXPECT_GT(compass.centre_px.y - compass.reach_px, 0.5F * size.y) << "titles are above";
    EXPECT_LT(compass.centre_px.y + compass.reach_px, 0.947F * size.y) << "the footer is below";
  }
}

}  // namespace
}  // namespace sunfleck

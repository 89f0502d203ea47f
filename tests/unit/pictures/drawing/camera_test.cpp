#include "pictures/drawing/camera.h"

#include "support/box_views.h"
#include "support/viewed_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

namespace sunfleck {
namespace {

// Covers about ten operations in double precision on numbers of order one: 10 x 2^-53 is 1e-15. The other three digits allow
// for differences of coordinates that are larger than the result.
constexpr double camera_tolerance = 1e-12;

void expect_near(glm::dvec3 a, glm::dvec3 b) {
  EXPECT_LT(glm::distance(a, b), camera_tolerance);
}

Camera oblique(double aspect = 4.0 / 3.0) {
  return look_at({3.0, 2.5, 3.0}, {0.9, 1.0, 1.2}, 0.7, aspect);
}

TEST(LookAt, GivesARightHandedFrameWithYUp) {
  const Camera camera = oblique();
  expect_near(camera.forward, glm::normalize(glm::dvec3(-2.1, -1.5, -1.8)));
  expect_near(glm::cross(camera.right, camera.up), -camera.forward);
  EXPECT_NEAR(glm::length(camera.right), 1.0, camera_tolerance);
  EXPECT_NEAR(camera.right.y, 0.0, camera_tolerance);
  EXPECT_GT(camera.up.y, 0.0);
  EXPECT_NEAR(camera.tan_half_fov, std::tan(0.35), camera_tolerance);
}

TEST(LookAt, PutsThePointLookedAtInTheMiddle) {
  const auto projection = project(oblique(), {0.9, 1.0, 1.2});
  ASSERT_TRUE(projection);
  EXPECT_NEAR(projection->at.x, 0.5, camera_tolerance);
  EXPECT_NEAR(projection->at.y, 0.5, camera_tolerance);
  EXPECT_NEAR(projection->depth_m, std::sqrt(2.1 * 2.1 + 1.5 * 1.5 + 1.8 * 1.8), camera_tolerance);
}

TEST(LookAt, TakesXAsUpWhenItLooksDownOrUp) {
  const Camera down = look_at({1.0, 5.0, 1.0}, {1.0, 0.0, 1.0}, 0.7, 1.0);
  expect_near(down.up, {1.0, 0.0, 0.0});
  expect_near(down.right, {0.0, 0.0, 1.0});  // seen from above, west is right of south
  const Camera up = look_at({1.0, 0.0, 1.0}, {1.0, 5.0, 1.0}, 0.7, 1.0);
  expect_near(up.up, {1.0, 0.0, 0.0});
  expect_near(up.right, {0.0, 0.0, -1.0});
}

TEST(LookAt, RefusesToLookAtItsOwnPosition) {
  EXPECT_THROW(static_cast<void>(look_at({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.7, 1.0)), std::logic_error);
}

TEST(Project, UndoesRayDirection) {
  for (const double aspect : {0.5, 1.0, 4.0 / 3.0, 2.4}) {
    const Camera camera = oblique(aspect);
    for (double y = 0.0; y <= 1.0; y += 0.125) {
      for (double x = 0.0; x <= 1.0; x += 0.125) {
        const glm::dvec3 direction = ray_direction(camera, {x, y});
        EXPECT_NEAR(glm::length(direction), 1.0, camera_tolerance);
        const auto projection = project(camera, camera.position_m + 7.0 * direction);
        ASSERT_TRUE(projection);
        EXPECT_NEAR(projection->at.x, x, camera_tolerance);
        EXPECT_NEAR(projection->at.y, y, camera_tolerance);
        EXPECT_NEAR(projection->depth_m, 7.0 * glm::dot(direction, camera.forward), 7.0 * camera_tolerance);
      }
    }
  }
}

TEST(Project, SpansTheFieldOfViewFromTopToBottom) {
  const Camera camera = oblique();
  const double angle = std::acos(glm::dot(ray_direction(camera, {0.5, 0.0}), ray_direction(camera, {0.5, 1.0})));
  EXPECT_NEAR(angle, 0.7, camera_tolerance);
}

TEST(Project, HasNothingBehindTheCamera) {
  const Camera camera = oblique();
  EXPECT_FALSE(project(camera, camera.position_m - camera.forward));
  EXPECT_FALSE(project(camera, camera.position_m));
}

std::vector<glm::dvec3> corners(const test::ViewedBox& box) {
  std::vector<glm::dvec3> points_m;
  for (unsigned i = 0; i < 8; ++i) {
    points_m.emplace_back((i & 1U) != 0 ? box.hi_m.x : box.lo_m.x, (i & 2U) != 0 ? box.hi_m.y : box.lo_m.y,
                          (i & 4U) != 0 ? box.hi_m.z : box.lo_m.z);
  }
  return points_m;
}

const std::vector<test::ViewedBox> camera_boxes = {{{0.0, 0.0, 0.0}, {1.8, 2.4, 2.4}},   {{0.0, 0.0, 0.0}, {30.0, 0.3, 2.0}},
                                                   {{0.0, 0.0, 0.0}, {0.5, 12.0, 0.5}},  {{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}},
                                                   {{-4.0, -1.0, 5.0}, {1.0, 2.0, 9.0}}, {{0.0, 0.0, 0.0}, {1e-3, 2e-3, 1e-3}}};

TEST(ThreeQuarterView, ShowsTheWholeBoxWithAMarginAndRoomForTitleAndLegend) {
  for (const test::ViewedBox& box : camera_boxes) {
    for (const double aspect : {0.5, 1.0, 4.0 / 3.0, 16.0 / 9.0, 2.4}) {
      const Camera camera = three_quarter_view(box.lo_m, box.hi_m, aspect);
      EXPECT_EQ(camera.aspect, aspect);
      for (const glm::dvec3& corner : corners(box)) {
        const auto projection = project(camera, corner);
        ASSERT_TRUE(projection);
        EXPECT_GT(projection->at.x, 0.025);
        EXPECT_LT(projection->at.x, 1.0 - 0.14);
        EXPECT_GT(projection->at.y, 0.14);
        EXPECT_LT(projection->at.y, 1.0 - 0.08);
      }
    }
  }
}

TEST(ThreeQuarterView, ShowsAxesThatReachBeyondTheBox) {
  for (const test::ViewedBox& box : camera_boxes) {
    const glm::dvec3 extent_m = box.hi_m - box.lo_m;
    const double overhang_m = axis_overhang * std::max({extent_m.x, extent_m.y, extent_m.z});
    const Camera camera = three_quarter_view(box.lo_m, box.hi_m, 4.0 / 3.0);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 tip_m = box.lo_m;
      tip_m[axis] = box.hi_m[axis] + overhang_m;
      const auto projection = project(camera, tip_m);
      ASSERT_TRUE(projection);
      EXPECT_GT(std::min(projection->at.x, projection->at.y), 0.04);
      EXPECT_LT(std::max(projection->at.x, projection->at.y), 0.96);
    }
  }
}

TEST(ThreeQuarterView, StandsSouthWestAndAbove) {
  for (const test::ViewedBox& box : camera_boxes) {
    const Camera camera = three_quarter_view(box.lo_m, box.hi_m, 4.0 / 3.0);
    EXPECT_LT(camera.forward.x, 0.0);
    EXPECT_LT(camera.forward.y, 0.0);
    EXPECT_LT(camera.forward.z, 0.0);
    EXPECT_GT(camera.position_m.y, box.hi_m.y);
  }
}

// No closer position would do: in one of the picture's two directions, points touch both sides of the window.
TEST(ThreeQuarterView, IsAsCloseAsTheMarginAllows) {
  const test::ViewedBox box = camera_boxes.front();
  Camera camera = three_quarter_view(box.lo_m, box.hi_m, 4.0 / 3.0);
  std::vector<glm::dvec3> points_m = corners(box);
  points_m.emplace_back(0.0, box.hi_m.y + axis_overhang * 2.4, 0.0);
  double top = 1.0, bottom = 0.0;
  for (const glm::dvec3& point : points_m) {
    const auto projection = project(camera, point);
    ASSERT_TRUE(projection);
    top = std::min(top, projection->at.y);
    bottom = std::max(bottom, projection->at.y);
  }
  EXPECT_NEAR(top, 0.15, camera_tolerance);
  EXPECT_NEAR(bottom, 1.0 - 0.085, camera_tolerance);
}

TEST(ThreeQuarterView, ScalesWithTheBox) {
  const Camera small = three_quarter_view({0.0, 0.0, 0.0}, {1.8, 2.4, 2.4}, 1.5);
  const Camera large = three_quarter_view({0.0, 0.0, 0.0}, {18.0, 24.0, 24.0}, 1.5);
  expect_near(small.position_m, large.position_m / 10.0);
}

}  // namespace
}  // namespace sunfleck

#include "pictures/drawing/camera_motion.h"

#include "support/box_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

constexpr double pi = std::numbers::pi;
const glm::dvec3 scene_middle(1.0, 0.5, -2.0);

HandCamera hand_aslant() {
  return in_hand(look_at({4.0, 3.0, 1.0}, scene_middle, 0.7, 1.5), scene_middle);
}

void expect_same_point(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

glm::dvec3 pivot(const HandCamera& hand) {
  return hand.camera.position_m + hand.distance_m * hand.camera.forward;
}

void expect_upright(const Camera& camera) {
  EXPECT_NEAR(glm::length(camera.forward), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-12);
  EXPECT_NEAR(glm::dot(camera.forward, camera.right), 0.0, 1e-12);
  expect_same_point(glm::cross(camera.right, camera.up), -camera.forward, 1e-12);
  EXPECT_NEAR(camera.right.y, 0.0, 1e-12) << "the horizon is level";
  EXPECT_GE(camera.up.y, -1e-12);
}

TEST(CameraInHand, TurnsAboutTheMiddleOfTheScene) {
  const HandCamera hand = hand_aslant();
  expect_same_point(pivot(hand), scene_middle, 1e-12);
}

TEST(Orbit, KeepsPointDistanceAndHorizon) {
  HandCamera hand = hand_aslant();
  for (int k = 0; k < 40; ++k) {
    orbit(hand, 0.31, k % 3 == 0 ? 0.4 : -0.23);
    expect_same_point(pivot(hand), scene_middle, 1e-9);
    expect_upright(hand.camera);
  }
}

TEST(Orbit, ByAFullTurnComesBack) {
  HandCamera hand = hand_aslant();
  const HandCamera before = hand;
  for (int k = 0; k < 8; ++k) orbit(hand, pi / 4, 0.0);
  expect_same_point(hand.camera.position_m, before.camera.position_m, 1e-9);
  expect_same_point(hand.camera.forward, before.camera.forward, 1e-12);
}

TEST(Orbit, StopsStraightAboveAndBelow) {
  HandCamera hand = hand_aslant();
  orbit(hand, 0.0, 10.0);
  expect_same_point(hand.camera.forward, {0, -1, 0}, 1e-9);
  expect_same_point(hand.camera.position_m, scene_middle + glm::dvec3(0, hand.distance_m, 0), 1e-9);
  expect_upright(hand.camera);
  orbit(hand, 0.0, -20.0);
  expect_same_point(hand.camera.forward, {0, 1, 0}, 1e-9);
}

TEST(Orbit, LeavesATopViewSideways) {
  HandCamera hand = in_hand(top_view({0, 0, 0}, {2, 1, 2}, 1.0), {1, 0.5, 1});
  const glm::dvec3 right = hand.camera.right;
  orbit(hand, 0.0, -0.5);
  expect_same_point(hand.camera.right, right, 1e-12);
  expect_upright(hand.camera);
  EXPECT_NEAR(hand.camera.forward.y, -std::cos(0.5), 1e-12);
}

TEST(Pan, MovesThePictureByAShareOfItsHeight) {
  HandCamera hand = hand_aslant();
  const Camera before = hand.camera;
  pan(hand, {0.25, -0.1}, 0.0);
  const auto seen = project(hand.camera, scene_middle);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->at.x, 0.5 - 0.25 / before.aspect, 1e-12);
  EXPECT_NEAR(seen->at.y, 0.5 - 0.1, 1e-12);
  EXPECT_EQ(hand.camera.forward, before.forward);
}

TEST(Zoom, ComesNearerToThePoint) {
  HandCamera hand = hand_aslant();
  const double distance_m = hand.distance_m;
  zoom(hand, 0.5);
  EXPECT_NEAR(hand.distance_m, 0.5 * distance_m, 1e-12);
  expect_same_point(pivot(hand), scene_middle, 1e-12);
  for (int k = 0; k < 100; ++k) zoom(hand, 0.5);
  EXPECT_GT(hand.distance_m, 0.0);
  expect_same_point(pivot(hand), scene_middle, 1e-9);
}

TEST(Zoom, OfParallelRaysShowsLess) {
  HandCamera hand = in_hand(side_view({0, 0, 0}, {2, 1, 2}, 1.0), {1, 0.5, 1});
  const Camera before = hand.camera;
  zoom(hand, 0.5);
  EXPECT_NEAR(hand.camera.half_height_m, 0.5 * before.half_height_m, 1e-12);
  EXPECT_EQ(hand.camera.position_m, before.position_m);
}

TEST(Fit, ShowsTheWholeBoxInTheSameDirection) {
  const glm::dvec3 lo(-1, 0, -4);
  const glm::dvec3 hi(3, 2, 1);
  for (HandCamera hand : {hand_aslant(), in_hand(top_view({0, 0, 0}, {1, 1, 1}, 0.6), {0, 0, 0})}) {
    const glm::dvec3 forward = hand.camera.forward;
    fit(hand, lo, hi);
    EXPECT_EQ(hand.camera.forward, forward);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at((corner & 1) != 0 ? hi.x : lo.x, (corner & 2) != 0 ? hi.y : lo.y, (corner & 4) != 0 ? hi.z : lo.z);
      const auto seen = project(hand.camera, at);
      ASSERT_TRUE(seen);
      EXPECT_TRUE(seen->at.x >= 0 && seen->at.x <= 1 && seen->at.y >= 0 && seen->at.y <= 1);
    }
  }
}

TEST(Fly, GoesWhereTheCameraLooks) {
  HandCamera hand = hand_aslant();
  const Camera before = hand.camera;
  fly(hand, {0, 0, 2});
  expect_same_point(hand.camera.position_m, before.position_m + 2.0 * before.forward, 1e-12);
}

TEST(Fisheye, StaysUprightAndMovesOverTheGround) {
  HandCamera hand = in_hand(fisheye_view({1, 0.1, 1}, 1.0), {1, 1, 1});
  const Camera before = hand.camera;
  orbit(hand, 1.0, 1.0);
  zoom(hand, 0.5);
  fit(hand, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(hand.camera.forward, before.forward);
  EXPECT_EQ(hand.camera.position_m, before.position_m);
  pan(hand, {0.5, 0.0}, 0.0);
  expect_same_point(hand.camera.position_m, before.position_m + glm::dvec3(0, 0, -0.5), 1e-12);  // moves east
  fly(hand, {0, 0.3, 0});
  EXPECT_NEAR(hand.camera.position_m.y, 0.4, 1e-12);
}

TEST(CameraToml, IsInTheAxesOfThePlot) {
  HandCamera hand = hand_aslant();
  hand.camera = look_at({3.0, 1.5, 3.5}, {0.75, 0.25, 1.0}, 0.7, 1.0);
  hand.distance_m = glm::distance(hand.camera.position_m, {0.75, 0.25, 1.0});
  const std::string toml = camera_toml(hand, {1.5, 2.25, true, Axes::east_north_up});
  EXPECT_TRUE(toml.starts_with("[camera]\nposition = [-1.2500, -1.5000, 1.5000]\nlook_at = [1.2500, 0.7500, 0.2500]\n"))
      << toml;
}

TEST(CameraToml, GivesTheSameCameraBack) {
  const HandCamera hand = hand_aslant();
  glm::dvec3 position(0);
  glm::dvec3 at(0);
  double fov = 0.0;
  ASSERT_EQ(
      std::sscanf(camera_toml(hand, {}).c_str(), "[camera]\nposition = [%lf, %lf, %lf]\nlook_at = [%lf, %lf, %lf]\nfov = %lf\n",
                  &position.x, &position.y, &position.z, &at.x, &at.y, &at.z, &fov),
      7);
  const Camera again = look_at(position, at, fov * pi / 180.0, hand.camera.aspect);
  expect_same_point(again.position_m, hand.camera.position_m, 1e-4);
  expect_same_point(again.forward, hand.camera.forward, 1e-4);
  EXPECT_NEAR(again.tan_half_fov, hand.camera.tan_half_fov, 1e-5);
  EXPECT_EQ(camera_toml(in_hand(top_view({0, 0, 0}, {1, 1, 1}, 1.0), {0, 0, 0}), {}), "") << "a scene's camera is a pinhole";
}

}  // namespace
}  // namespace sunfleck

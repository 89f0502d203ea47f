#include "physics/canopy/element_corners.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck {
namespace {

Triangle triangle_at(float x) {
  return {glm::vec3(x, 0.0F, 0.0F), glm::vec3(x + 1.0F, 0.0F, 0.0F), glm::vec3(x, 0.0F, 1.0F)};
}

shared::CopyTurn moved_by(float x) {
  return {.shift = glm::vec3(x, 0.0F, 0.0F),
          .cos_out = 1.0F,
          .sin_out = 0.0F,
          .scale = 1.0F,
          .cos_back = 1.0F,
          .sin_back = 0.0F,
          .per_scale = 1.0F};
}

// Returns 1,000 triangles of a mesh at x = 0, 1, ..., so that a copy spans several entries of the list's index.
SharedMesh long_mesh() {
  SharedMesh mesh;
  for (int t = 0; t < 1000; ++t) mesh.corners.push_back(triangle_at(static_cast<float>(t)));
  mesh.traced.assign(mesh.corners.size(), true);
  return mesh;
}

// Every triangle knows its place by its first x.
TEST(ElementCorners, AreInTheOrderInWhichTheyWereAdded) {
  ElementCorners corners;
  std::vector<float> expected;
  std::vector<std::uint32_t> own;
  const auto add_own = [&](int count) {
    for (int k = 0; k < count; ++k) {
      own.push_back(static_cast<std::uint32_t>(expected.size()));
      expected.push_back(-1.0F - static_cast<float>(expected.size()));
      corners.push_back(triangle_at(expected.back()));
    }
  };
  const std::uint32_t mesh = corners.add_mesh(long_mesh());
  const auto add_copy = [&](float x) {
    corners.add_copy(mesh, moved_by(x));
    for (int t = 0; t < 1000; ++t) expected.push_back(x + static_cast<float>(t));
  };
  add_own(700);
  add_copy(1e4F);
  add_copy(2e4F);
  add_own(1);
  add_copy(3e4F);
  add_own(600);
  ASSERT_EQ(corners.size(), expected.size());
  for (std::size_t e = 0; e < expected.size(); ++e) ASSERT_EQ(corners[e][0].x, expected[e]) << e;
  std::size_t e = 0;
  for (const Triangle& triangle : corners) ASSERT_EQ(triangle[0].x, expected[e++]);
  EXPECT_EQ(e, expected.size());
  EXPECT_EQ(corners.own_elements(), own);
  for (std::size_t k = 0; k < own.size(); ++k) EXPECT_EQ(corners.own()[k][0].x, expected[own[k]]);
  ASSERT_EQ(corners.copies().size(), 3U);
  EXPECT_EQ(corners.copies()[2].first_element, 2701U);
  EXPECT_EQ(ElementCorners(corners.all()), corners);
}

TEST(ElementCorners, OfCopiesAreTurnedClockwiseAndScaled) {
  ElementCorners corners;
  SharedMesh mesh;
  mesh.corners = {{glm::vec3(1.0F, 2.0F, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F), glm::vec3(0.0F, 1.0F, 0.0F)}};
  mesh.traced = {true};
  // Half the size, with south turned to west.
  corners.add_copy(corners.add_mesh(mesh), {.shift = glm::vec3(10.0F, 20.0F, 30.0F),
                                            .cos_out = 0.0F,
                                            .sin_out = 0.5F,
                                            .scale = 0.5F,
                                            .cos_back = 0.0F,
                                            .sin_back = 2.0F,
                                            .per_scale = 2.0F});
  const Triangle placed = corners[0];
  EXPECT_EQ(placed[0], glm::vec3(10.0F, 21.0F, 30.5F));
  EXPECT_EQ(placed[1], glm::vec3(9.5F, 20.0F, 30.0F));
  const shared::CopyTurn turn = corners.copies()[0].turn;
  const shared::Ray ray = shared::turned_ray(turn, shared::make_ray(placed[0], {0.0F, -1.0F, 0.0F}));
  EXPECT_EQ(ray.origin, mesh.corners[0][0]);
  EXPECT_EQ(ray.direction, glm::vec3(0.0F, -2.0F, 0.0F));
}

}  // namespace
}  // namespace sunfleck

#include "files/formats/mesh/polygon_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

using Polygon = std::vector<glm::dvec3>;

glm::dvec3 half_cross(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 area_of(const Polygon& polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += half_cross(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

// Expects triangles that cover the polygon once: together they have its area, and none is turned over.
void expect_covered(const Polygon& polygon) {
  const std::vector<CornerTriangle> triangles = cut_ears(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const glm::dvec3 whole = area_of(polygon);
  double sum = 0.0;
  std::vector<int> uses(polygon.size());
  for (const CornerTriangle& triangle : triangles) {
    const glm::dvec3 area = half_cross(polygon.at(triangle[0]), polygon.at(triangle[1]), polygon.at(triangle[2]));
    EXPECT_GE(glm::dot(area, whole), -1e-12 * glm::dot(whole, whole));
    sum += glm::length(area);
    for (const std::uint32_t corner : triangle) ++uses[corner];
  }
  EXPECT_NEAR(sum, glm::length(whole), 1e-9 * glm::length(whole));
  EXPECT_GT(*std::min_element(uses.begin(), uses.end()), 0);
}

// Turns a flat polygon out of the level, far from zero.
Polygon placed(const Polygon& flat) {
  const glm::dvec3 u = glm::normalize(glm::dvec3(0.3, 0.8, -0.2)), v = glm::normalize(glm::cross(u, glm::dvec3(1.0, 0.0, 0.4)));
  Polygon polygon;
  for (const glm::dvec3& corner : flat) polygon.push_back(glm::dvec3(4e5, 12.0, -3e5) + corner.x * u + corner.y * v);
  return polygon;
}

const Polygon house{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0.2, 0}, {0, 1, 0}};

TEST(PolygonCut, FindsFansThatFold) {
  EXPECT_FALSE(fan_folds(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_FALSE(fan_folds(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_TRUE(fan_folds(house));
  Polygon from_notch = house;
  std::rotate(from_notch.begin(), from_notch.begin() + 3, from_notch.end());
  EXPECT_FALSE(fan_folds(from_notch)) << "the fan about the corner of the notch is good";
}

TEST(PolygonCut, CoversWhatIsNotConvexOnce) {
  for (std::size_t first = 0; first < house.size(); ++first) {
    Polygon turned = house;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
    expect_covered(turned);
    expect_covered(placed(turned));
    std::reverse(turned.begin(), turned.end());
    expect_covered(placed(turned));
  }
}

// A lobed leaf, a spiral and a comb, whose polygon mostly turn the other way or lie on one line.
TEST(PolygonCut, CoversLeavesSpiralsAndCombs) {
  Polygon leaf, spiral, comb;
  for (int k = 0; k < 200; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 200.0, radius = 1.0 + 0.6 * std::sin(7.0 * angle);
    leaf.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  for (int k = 0; k < 120; ++k)
    spiral.emplace_back((1.0 + 0.05 * k) * std::cos(0.2 * k), (1.0 + 0.05 * k) * std::sin(0.2 * k), 0.0);
  for (int k = 119; k >= 0; --k)
    spiral.emplace_back((1.2 + 0.05 * k) * std::cos(0.2 * k), (1.2 + 0.05 * k) * std::sin(0.2 * k), 0.0);
  comb.emplace_back(0.0, 0.0, 0.0);
  comb.emplace_back(249.0, 0.0, 0.0);
  for (int k = 249; k > 0; --k) {
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, {0.6, 5.0}, {0.4, 5.0}, {0.2, 1.0}}) {
      if (comb.size() < most_corners_with_ears) comb.emplace_back(k - 1.0 + x, y, 0.0);
    }
  }
  for (const Polygon& polygon : {leaf, spiral, comb}) {
    expect_covered(polygon);
    expect_covered(placed(polygon));
  }
}

TEST(PolygonCut, CutsWhatCrossesItselfOrHasNoArea) {
  EXPECT_EQ(cut_ears(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2U);
  EXPECT_EQ(cut_ears(Polygon(6, glm::dvec3(1.0))).size(), 4U);
  EXPECT_EQ(cut_ears(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}).size(), 3U);
}

}  // namespace
}  // namespace sunfleck

#include "shared/intersect.h"

#include "support/bvh_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sunfleck::shared {
namespace {

using testing_bvh::point;
using testing_bvh::Random;
using testing_bvh::uniform;

TriangleHit meet(const Ray& ray, const Triangle& corners) {
  return meet_triangle(ray, corners[0], corners[1], corners[2]);
}

glm::dvec3 at_weights(const Triangle& corners, double b, double c) {
  const glm::dvec3 a(corners[0]);
  return a + b * (glm::dvec3(corners[1]) - a) + c * (glm::dvec3(corners[2]) - a);
}

// Returns the directions to all faces, edges and corners of a cube.
std::vector<glm::vec3> lattice_directions() {
  std::vector<glm::vec3> directions;
  for (int k = 0; k < 27; ++k) {
    if (k != 13) directions.emplace_back(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
  }
  return directions;
}

TEST(MakeRay, ShearsAlongTheLargestComponent) {
  EXPECT_EQ(make_ray({}, {3, -2, 1}).axis, 0U);
  EXPECT_EQ(make_ray({}, {-1, -2, 1}).axis, 1U);
  EXPECT_EQ(make_ray({}, {1, 0, -7}).axis, 2U);
  EXPECT_EQ(make_ray({}, {1, 1, 1}).axis, 2U);
  const Ray ray = make_ray({1, 2, 3}, {0, -4, 1});
  EXPECT_EQ(ray.inverse, vec3(0x1p60F, exact_reciprocal(-4.0F), exact_reciprocal(1.0F)));
  // z and x over y: the axes cyclic after y
  EXPECT_EQ(ray.shear, vec3(exact_reciprocal(-4.0F), 0.0F, exact_reciprocal(-4.0F)));
}

// A ray against the upper face's normal meets the upper face, and a reversed ray the lower one.
TEST(MeetTriangle, TellsTheFaceForEveryDirection) {
  Random random(1);
  for (const glm::vec3& lattice : lattice_directions()) {
    for (int k = 0; k < 200; ++k) {
      const glm::vec3 direction = k < 100 ? lattice : lattice + point(random, 0.3);
      Triangle corners{point(random, 1.0), point(random, 1.0), point(random, 1.0)};
      const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0]));
      if (std::abs(glm::dot(glm::normalize(normal), glm::normalize(glm::dvec3(direction)))) < 0.01) continue;
      const glm::dvec3 target = at_weights(corners, 0.3, 0.3);
      const Ray ray = make_ray(glm::vec3(target - 2.0 * glm::dvec3(direction)), direction);
      const TriangleHit hit = meet(ray, corners);
      ASSERT_TRUE(hit.met);
      EXPECT_EQ(hit.lower, glm::dot(normal, glm::dvec3(direction)) > 0.0 ? 1U : 0U);
      EXPECT_EQ(meet_triangle(ray, corners[0], corners[2], corners[1]).lower, 1U - hit.lower);
    }
  }
}

// Corners are known to a few roundings of their distance (below 8 here), which a grazing ray stretches by 1 / cosine.
TEST(MeetTriangle, GivesPlaceAndDistance) {
  Random random(2);
  int met = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Triangle corners{point(random, 1.0), point(random, 1.0), point(random, 1.0)};
    const double b = uniform(random, -0.2, 1.0);
    const double c = uniform(random, -0.2, 1.0);
    const glm::vec3 origin = point(random, 4.0);
    const glm::vec3 direction = glm::vec3(at_weights(corners, b, c)) - origin;
    const glm::dvec3 cross = glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0]));
    const double cosine = std::abs(glm::dot(glm::normalize(cross), glm::normalize(glm::dvec3(direction))));
    // Twice the area, divided by an upper bound of the longest edge.
    const double smallest_height = glm::length(cross) / 4.0;
    const double tolerance = 8.0 * 0x1p-20 / (cosine * smallest_height);
    if (tolerance > 0.01 || std::min({b, c, 1.0 - b - c}) == 0.0) continue;
    const TriangleHit hit = meet(make_ray(origin, direction), corners);
    if (std::abs(std::min({b, c, 1.0 - b - c})) > tolerance) {
      ASSERT_EQ(hit.met, std::min({b, c, 1.0 - b - c}) > 0.0);
    }
    if (!hit.met) continue;
    ++met;
    EXPECT_NEAR(hit.t, 1.0, tolerance);
    EXPECT_NEAR(hit.weight_b, b, tolerance);
    EXPECT_NEAR(hit.weight_c, c, tolerance);
  }
  EXPECT_GT(met, 5'000);
}

TEST(MeetTriangle, MeetsNothingBehindOrEdgeOnOrWithoutArea) {
  const Triangle level{vec3(0, 1, 0), vec3(0, 1, 1), vec3(1, 1, 0)};
  EXPECT_TRUE(meet(make_ray({0.25F, 2, 0.25F}, {0, -1, 0}), level).met);
  EXPECT_FALSE(meet(make_ray({0.25F, 2, 0.25F}, {0, 1, 0}), level).met);
  EXPECT_FALSE(meet(make_ray({0.25F, 1, 0.25F}, {0, -1, 0}), level).met);  // starts in the triangle's plane
  EXPECT_FALSE(meet(make_ray({-1, 1, 0.25F}, {1, 0, 0}), level).met);
  EXPECT_FALSE(meet(make_ray({-1, 1, -1}, {1, 0, 1}), level).met);
  EXPECT_FALSE(meet(make_ray({0, 2, 0}, {0, -1, 0}), {vec3(0, 1, 0), vec3(0, 1, 0), vec3(1, 1, 0)}).met);
  EXPECT_FALSE(meet(make_ray({0.5F, 2, 0}, {0, -1, 0}), {vec3(0, 1, 0), vec3(1, 1, 0), vec3(2, 1, 0)}).met);
  EXPECT_FALSE(meet(make_ray({0, 2, 0}, {0, -1, 0}), {vec3(0, 1, 0), vec3(0, 1, 0), vec3(0, 1, 0)}).met);
}

// Along an axis nothing is rounded: points of the edges are met exactly, corners included, from both sides.
TEST(MeetTriangle, IncludesItsEdges) {
  const Triangle level{vec3(0, 0, 0), vec3(0, 0, 1), vec3(1, 0, 0)};
  const vec3 edge_points[] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0.5F, 0, 0}, {0, 0, 0.25F}, {0.75F, 0, 0.25F}};
  for (uint axis = 0; axis < 3; ++axis) {
    const Triangle corners{axis_last(level[0], axis), axis_last(level[1], axis), axis_last(level[2], axis)};
    for (const vec3& point : edge_points) {
      for (const float y : {1.0F, -1.0F}) {
        const vec3 direction = axis_last(vec3(0, y, 0), axis);
        EXPECT_TRUE(meet(make_ray(axis_last(point, axis) - direction, direction), corners).met);
      }
    }
  }
}

// Counts the hits of the quadrilateral a b c d, cut along a c, with its corners numbered in any order.
int met_of_quad(const Ray& ray, const std::array<glm::vec3, 4>& quad, int order) {
  const Triangle first{quad[0], quad[1], quad[2]};
  const Triangle second{quad[0], quad[2], quad[3]};
  const auto turned = [](const Triangle& t, int turn) {
    const auto k = static_cast<std::size_t>(turn);
    return Triangle{t[k % 3], t[(k + 1) % 3], t[(k + 2) % 3]};
  };
  const auto flipped = [](const Triangle& t) { return Triangle{t[0], t[2], t[1]}; };
  const Triangle one = turned(order % 2 == 0 ? first : flipped(first), order / 4);
  const Triangle other = turned(order / 2 % 2 == 0 ? second : flipped(second), order / 12);
  return (meet(ray, one).met ? 1 : 0) + (meet(ray, other).met ? 1 : 0);
}

// Returns the cross product of two vectors as seen along the direction; its sign shows on which side the second lies.
double seen_cross(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& direction) {
  return glm::dot(glm::cross(a, b), glm::normalize(direction));
}

TEST(MeetTriangle, LetsNoRayThroughACommonEdge) {
  Random random(3);
  int rays = 0;
  for (int k = 0; k < 200'000; ++k) {
    const std::array<glm::vec3, 4> quad{point(random, 1.0), point(random, 1.0), point(random, 1.0), point(random, 1.0)};
    const glm::vec3 along = quad[2] - quad[0];
    const glm::vec3 target = quad[0] + static_cast<float>(uniform(random, 0.1, 0.9)) * along;
    const glm::vec3 origin = point(random, 3.0);
    const glm::vec3 direction = target - origin;
    // The corners b and d have to be on opposite sides of the edge as the ray sees it, well clear of it.
    const double b = seen_cross(along, quad[1] - quad[0], direction);
    const double d = seen_cross(along, quad[3] - quad[0], direction);
    if (b * d > 0.0 || std::min(std::abs(b), std::abs(d)) < 0.01 || glm::length(direction) < 0.1) continue;
    ++rays;
    ASSERT_GE(met_of_quad(make_ray(origin, direction), quad, k % 36), 1) << k;
  }
  EXPECT_GT(rays, 50'000);
}

// A fan of triangles surrounds a corner at which rays aim: lattice points, where products vanish, and others.
TEST(MeetTriangle, LetsNoRayThroughACommonCorner) {
  Random random(4);
  for (int k = 0; k < 50'000; ++k) {
    const bool on_lattice = k % 2 == 0;
    const glm::vec3 direction = on_lattice ? lattice_directions()[static_cast<std::size_t>(k / 2 % 26)] : point(random, 1.0);
    if (glm::length(direction) < 0.1) continue;
    const glm::vec3 middle = on_lattice ? glm::round(point(random, 4.0)) * 0.25F : point(random, 1.0);
    const glm::vec3 u = glm::normalize(glm::cross(direction, vec3(0.3F, 0.5F, -0.8F)));
    const glm::vec3 v = glm::normalize(glm::cross(direction, u));
    constexpr int blades = 5;
    std::array<glm::vec3, blades> rim;
    for (int i = 0; i < blades; ++i) {
      const auto angle = static_cast<float>(6.283185307 * (i + uniform(random, -0.2, 0.2)) / blades);
      rim[static_cast<std::size_t>(i)] = middle + std::cos(angle) * u + std::sin(angle) * v + point(random, 0.1);
    }
    const Ray ray = make_ray(middle - 2.0F * direction, direction);
    int met = 0;
    for (std::size_t i = 0; i < blades; ++i) met += meet_triangle(ray, middle, rim[i], rim[(i + 1) % blades]).met ? 1 : 0;
    ASSERT_GE(met, 1) << k;
  }
}

TEST(HitPrecedes, PutsTheNearerFirstThenTheLowerNumberThenTheFirstCopy) {
  EXPECT_TRUE(hit_precedes({1.0F, 9, 9}, {2.0F, 1, 1}));
  EXPECT_FALSE(hit_precedes({2.0F, 1, 1}, {1.0F, 9, 9}));
  EXPECT_TRUE(hit_precedes({1.0F, 1, 9}, {1.0F, 2, 1}));
  EXPECT_FALSE(hit_precedes({1.0F, 2, 1}, {1.0F, 1, 9}));
  EXPECT_TRUE(hit_precedes({1.0F, 2, 1}, {1.0F, 2, 3}));
  EXPECT_FALSE(hit_precedes({1.0F, 2, 3}, {1.0F, 2, 1}));
  EXPECT_FALSE(hit_precedes({1.0F, 2, 3}, {1.0F, 2, 3}));
}

}  // namespace
}  // namespace sunfleck::shared

// Tests how packets leave a surface, against double precision.

#include "shared/emission.h"

#include "support/chi_square.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace sunfleck::shared {
namespace {

const vec3 straight_up(0.0F, 1.0F, 0.0F);

double between(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
}

vec3 some_corner(std::mt19937& random, double half_size) {
  const auto x = static_cast<float>(between(random, -half_size, half_size));
  const auto y = static_cast<float>(between(random, -half_size, half_size));
  return {x, y, static_cast<float>(between(random, -half_size, half_size))};
}

vec3 some_normal(std::mt19937& random) {
  const vec3 a = some_corner(random, 1.0);
  const vec3 b = some_corner(random, 1.0);
  return exact_normal(a, b, some_corner(random, 1.0));
}

// Expects the normal to be as precise as its edges, of which rounding turns each by up to 2^-24 of its length: a sliver's
// normal is less precise.
void expect_normal(const vec3& a, const vec3& b, const vec3& c) {
  const glm::dvec3 along_b = glm::dvec3(b) - glm::dvec3(a);
  const glm::dvec3 along_c = glm::dvec3(c) - glm::dvec3(a);
  const glm::dvec3 cross = glm::cross(along_b, along_c);
  const double sine = glm::length(cross) / (glm::length(along_b) * glm::length(along_c));
  const glm::dvec3 normal(exact_normal(a, b, c));
  EXPECT_NEAR(glm::length(normal), 1.0, 3e-7);
  EXPECT_LE(glm::length(normal - glm::normalize(cross)), 0x1p-21 + 0x1p-22 / sine) << "sine " << sine;
}

// An inverse root may be a unit in the last place off, even that of 1.
void expect_axis(const vec3& normal, const vec3& axis) {
  EXPECT_LE(glm::length(normal - axis), 0x1p-22F) << normal.x << ' ' << normal.y << ' ' << normal.z;
}

TEST(ExactNormal, IsThatOfTheUpperSide) {
  expect_axis(exact_normal({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}), straight_up);
  expect_axis(exact_normal({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}), -straight_up);
  expect_axis(exact_normal({5.0F, 1.0F, 2.0F}, {5.0F, 3.0F, 2.0F}, {5.0F, 1.0F, 7.0F}), {1.0F, 0.0F, 0.0F});
  std::mt19937 random(1);
  for (int k = 0; k < 20'000; ++k) {
    const vec3 a = some_corner(random, 1.0);
    const vec3 b = some_corner(random, 1.0);
    expect_normal(a, b, some_corner(random, 1.0));
  }
}

TEST(ExactNormal, OfHugeAndTinyTrianglesIsAsPrecise) {
  std::mt19937 random(2);
  for (int exponent = -114; exponent <= 126; exponent += 4) {
    const double size = std::ldexp(1.0, exponent);
    for (int k = 0; k < 200; ++k) {
      const vec3 a = some_corner(random, size);
      const vec3 b = some_corner(random, size);
      expect_normal(a, b, some_corner(random, size));
      expect_normal(a, b, a + (b - a) * 0.75F + some_corner(random, size * 0x1p-9));
    }
  }
}

TEST(ExactNormal, OfSliversIsAsPreciseAsTheirEdges) {
  std::mt19937 random(3);
  for (int k = 0; k < 20'000; ++k) {
    const vec3 a = some_corner(random, 1.0);
    const vec3 b = some_corner(random, 1.0);
    const double width = std::ldexp(1.0, -static_cast<int>(random() % 18U));
    const vec3 c = a + (b - a) * static_cast<float>(between(random, 0.1, 2.0)) + some_corner(random, width);
    expect_normal(a, b, c);
  }
}

TEST(ExactNormal, OfSliversDoesNotUnderflow) {
  for (const float width : {1e-3F, 1e-10F, 1e-20F, 1e-30F}) {
    SCOPED_TRACE(width);
    expect_axis(exact_normal(vec3(0.0F), {0.0F, 0.0F, 1.0F}, {width, 0.0F, 0.0F}), straight_up);
    expect_axis(exact_normal(vec3(0.0F), {0.0F, 0.0F, width}, {width, 0.0F, 0.0F}), straight_up);
    expect_axis(exact_normal(vec3(0.0F), {width, 0.0F, 1.0F}, {width, 0.0F, 0.0F}), straight_up);
    expect_axis(exact_normal(vec3(0.0F), {0.0F, 0.0F, 1e30F}, {width, 0.0F, 1e30F}), straight_up);
  }
}

TEST(ExactNormal, WithoutAreaIsStraightUp) {
  std::mt19937 random(4);
  for (int k = 0; k < 1'000; ++k) {
    const vec3 a = some_corner(random, 1.0);
    const vec3 b = some_corner(random, 1.0);
    EXPECT_EQ(exact_normal(a, a, a), straight_up);
    EXPECT_EQ(exact_normal(a, a, b), straight_up);
    EXPECT_EQ(exact_normal(a, b, a), straight_up);
    EXPECT_EQ(exact_normal(a, b, b), straight_up);
    const vec3 corner = glm::floor(a * 64.0F);
    const vec3 edge = glm::floor(b * 64.0F);
    EXPECT_EQ(exact_normal(corner, corner + edge * 3.0F, corner - edge * 7.0F), straight_up);
  }
}

// Expects the turn of a word to be where it belongs; the series end at 3e-7, and the word's last six bits do not count.
void expect_turn(uint word) {
  const glm::dvec2 turn(exact_turn(word));
  const double angle = 2.0 * std::numbers::pi * (static_cast<double>(word) * 0x1p-32 - 0.125);
  ASSERT_NEAR(turn.x, std::cos(angle), 6e-7) << word;
  ASSERT_NEAR(turn.y, std::sin(angle), 6e-7) << word;
  ASSERT_NEAR(glm::length(turn), 1.0, 6e-7) << word;
}

TEST(ExactTurn, GoesOnceRoundTheUnitCircle) {
  for (uint k = 0; k < 1U << 18U; ++k) expect_turn(k * 16384U + k % 16384U);
  for (const uint quarter : {0U, 1U << 30U, 1U << 31U, 3U << 30U}) {
    for (uint k = 0; k < 300; ++k) {
      expect_turn(quarter + k);
      expect_turn(quarter - k);
    }
  }
}

// About the normal, the squared cosine of a cosine-distributed direction is even, and so is the azimuth.
TEST(CosineDirection, IsCosineDistributed) {
  constexpr std::size_t side = 24;
  constexpr uint count = 1U << 18U;
  std::mt19937 random(5);
  std::vector<vec3> normals = {straight_up, -straight_up, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}};
  for (int k = 0; k < 3; ++k) normals.push_back(some_normal(random));
  for (std::size_t which = 0; which < normals.size(); ++which) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(normals[which]));
    const glm::dvec3 helper = std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(normal, helper));
    const glm::dvec3 along = glm::cross(normal, across);
    std::vector<std::uint64_t> bins(side * side);
    for (uint k = 0; k < count; ++k) {
      const uvec4 words = random_words({3, static_cast<uint>(which)}, k, 0);
      const glm::dvec3 direction = glm::normalize(glm::dvec3(cosine_direction(normals[which], words.x, words.y)));
      const double cosine = glm::dot(direction, normal);
      ASSERT_GT(cosine, 0.0);
      const double turn = std::atan2(glm::dot(direction, across), glm::dot(direction, along)) / (2.0 * std::numbers::pi) + 0.5;
      const auto bin = [](double part) {
        return std::min(side - 1, static_cast<std::size_t>(part * static_cast<double>(side)));
      };
      ++bins[bin(cosine * cosine) * side + bin(turn)];
    }
    test::expect_flat(bins, "squared cosine and azimuth");
  }
}

// Searches among the words whose points on the sphere are opposite to the normal.
TEST(CosineDirection, IsNeverBelowTheSurface) {
  std::mt19937 random(6);
  int straight = 0;
  int grazing = 0;
  for (int k = 0; k < 300; ++k) {
    const vec3 normal = k == 0 ? straight_up : some_normal(random);
    const glm::dvec3 exact(normal);
    const double turn = std::atan2(-exact.y, -exact.x) / (2.0 * std::numbers::pi) + 0.125;
    const auto opposite_u = static_cast<std::int64_t>((1.0 + exact.z) / 2.0 * 0x1p32);
    const auto opposite_v = static_cast<std::int64_t>((turn - std::floor(turn)) * 0x1p32);
    for (int tried = 0; tried < 500; ++tried) {
      const double reach = std::ldexp(1.0, 10 + static_cast<int>(random() % 15U));
      const auto beside = [&](std::int64_t word) {
        return static_cast<uint>(std::clamp<std::int64_t>(word + static_cast<std::int64_t>(between(random, -reach, reach)), 0,
                                                          static_cast<std::int64_t>(0xffffffffU)));
      };
      const uint u = beside(opposite_u);
      const uint v = beside(opposite_v);
      const vec3 direction = cosine_direction(normal, u, v);
      const double sine = glm::dot(glm::dvec3(direction), exact) / glm::length(glm::dvec3(direction));
      ASSERT_GT(sine, 6e-4) << u << ' ' << v;
      straight += direction == normal ? 1 : 0;
      grazing += sine < 2e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(straight, 1'000);
  EXPECT_GT(grazing, 1'000);
}

TEST(EvenWeights, AreThoseOfPointsInTheTriangle) {
  constexpr std::array<uint, 8> ends = {0, 0xffU, 0x100U, 0x7fffffffU, 0x80000000U, 0xfffffeffU, 0xffffff00U, 0xffffffffU};
  for (const uint u : ends) {
    for (const uint v : ends) {
      const vec2 weights = even_weights(u, v);
      EXPECT_GE(weights.x, 0.0F) << u << ' ' << v;
      EXPECT_GE(weights.y, 0.0F) << u << ' ' << v;
      EXPECT_LE(static_cast<double>(weights.x) + static_cast<double>(weights.y), 1.0) << u << ' ' << v;
    }
  }
  EXPECT_EQ(even_weights(0, 0x12345678U), vec2(0.0F));
}

// Counts the points in 256 triangles of the same area, into which lines parallel to its edges divide the triangle.
TEST(EvenWeights, AreSpreadEvenlyOverTheTriangle) {
  constexpr std::size_t side = 16;
  std::vector<std::uint64_t> bins(side * side);
  for (uint k = 0; k < 1U << 18U; ++k) {
    const uvec4 words = random_words({5, 6}, k, 0);
    const vec2 weights = even_weights(words.x, words.y) * static_cast<float>(side);
    const vec2 corner = glm::floor(weights);
    const auto row = static_cast<std::size_t>(corner.x);
    const auto column = static_cast<std::size_t>(corner.y);
    const bool upper = weights.x - corner.x + weights.y - corner.y > 1.0F;
    ASSERT_LT(row + column + (upper ? 1 : 0), side);
    // Row by row there are two triangles fewer.
    ++bins[row * (2 * side - row) + 2 * column + (upper ? 1 : 0)];
  }
  test::expect_flat(bins, "parts of the triangle");
}

TEST(PointOnTriangle, IsThatOfItsWeights) {
  std::mt19937 random(7);
  for (int k = 0; k < 10'000; ++k) {
    const vec3 a = some_corner(random, 4.0);
    const vec3 b = some_corner(random, 4.0);
    const vec3 c = some_corner(random, 4.0);
    const auto u = static_cast<uint>(random());
    const vec2 weights = even_weights(u, static_cast<uint>(random()));
    const glm::dvec3 exact = glm::dvec3(a) + (glm::dvec3(b) - glm::dvec3(a)) * static_cast<double>(weights.x) +
                             (glm::dvec3(c) - glm::dvec3(a)) * static_cast<double>(weights.y);
    ASSERT_LE(glm::length(glm::dvec3(point_on_triangle(a, b, c, weights.x, weights.y)) - exact), 4e-6);
  }
  const vec3 a(1.0F, 2.0F, 3.0F);
  const vec3 b(5.0F, 1.0F, 4.0F);
  const vec3 c(-2.0F, 0.0F, 8.0F);
  EXPECT_EQ(point_on_triangle(a, b, c, 0.0F, 0.0F), a);
  EXPECT_EQ(point_on_triangle(a, b, c, 1.0F, 0.0F), b);
  EXPECT_EQ(point_on_triangle(a, b, c, 0.0F, 1.0F), c);
}

// The face of a box ends at its neighbours, and so do the points on it.
TEST(PointOnTriangle, StaysWithinTheBoxOfItsCorners) {
  std::mt19937_64 random(31);
  const auto unit = [&] { return unit_interval(static_cast<uint>(random())); };
  for (int k = 0; k < 200'000; ++k) {
    const vec3 a(1.1F, unit(), 0.3F), b(0.3F, unit(), 1.7F), c(1.1F, unit(), 1.7F);
    const vec2 weights = even_weights(static_cast<uint>(random()), k % 2 == 0 ? 0U : static_cast<uint>(random()));
    const vec3 at = point_on_triangle(a, b, c, weights.x, weights.y);
    ASSERT_LE(at.x, 1.1F);
    ASSERT_GE(at.x, 0.3F);
    ASSERT_GE(at.z, 0.3F);
    ASSERT_LE(at.z, 1.7F);
  }
}

TEST(PointAlong, GoesAlongTheDirection) {
  EXPECT_EQ(point_along({1.0F, 2.0F, 3.0F}, straight_up, 0.25F), vec3(1.0F, 2.25F, 3.0F));
  EXPECT_EQ(point_along({1.0F, 2.0F, 3.0F}, {0.5F, -0.5F, -1.0F}, 0.5F), vec3(1.25F, 1.75F, 2.5F));
}

// Expects a coordinate to lie in the period and to add up again within the rounding of its size.
void expect_wrapped(float x, float period_m) {
  const Wrapped wrapped = wrapped_into(x, period_m, 1.0F / period_m);
  ASSERT_GE(wrapped.at, 0.0F) << x << " into " << period_m;
  ASSERT_LE(wrapped.at, period_m) << x << " into " << period_m;
  ASSERT_EQ(wrapped.periods, std::floor(wrapped.periods));
  const double sum = static_cast<double>(wrapped.at) + static_cast<double>(wrapped.periods) * static_cast<double>(period_m);
  const double size = std::fmax(std::abs(static_cast<double>(x)), static_cast<double>(period_m));
  ASSERT_NEAR(sum, static_cast<double>(x), 0x1.8p-23 * size) << x << " into " << period_m;
}

TEST(WrappedInto, LiesInThePeriodAndAddsUpAgain) {
  std::mt19937 random(8);
  for (int k = 0; k < 100'000; ++k) {
    const auto period_m = static_cast<float>(between(random, 0.01, 20.0));
    const double reach = std::ldexp(1.0, static_cast<int>(random() % 20U) - 8);
    expect_wrapped(static_cast<float>(between(random, -reach, reach)), period_m);
  }
}

TEST(WrappedInto, ChangesNothingWithinThePeriod) {
  std::mt19937 random(9);
  for (int k = 0; k < 10'000; ++k) {
    const auto period_m = static_cast<float>(between(random, 0.01, 20.0));
    const float x = period_m * static_cast<float>(between(random, 0.0, 0.999));
    const Wrapped wrapped = wrapped_into(x, period_m, 1.0F / period_m);
    ASSERT_EQ(wrapped.at, x);
    ASSERT_EQ(wrapped.periods, 0.0F);
  }
}

TEST(WrappedInto, HoldsAtTheBorders) {
  for (const float period_m : {0.7F, 1.0F, 1.7F, 3.0F, 12.3F}) {
    for (int periods = -20; periods <= 20; ++periods) {
      const float border = period_m * static_cast<float>(periods);
      expect_wrapped(border, period_m);
      expect_wrapped(std::nextafter(border, -1e9F), period_m);
      expect_wrapped(std::nextafter(border, 1e9F), period_m);
    }
    expect_wrapped(-0.0F, period_m);
    expect_wrapped(-1e-9F, period_m);
    EXPECT_EQ(wrapped_into(0.0F, period_m, 1.0F / period_m).periods, 0.0F);
    EXPECT_EQ(wrapped_into(-1e-9F, period_m, 1.0F / period_m).periods, -1.0F);
  }
  EXPECT_EQ(wrapped_into(7.25F, 2.0F, 0.5F).at, 1.25F);
  EXPECT_EQ(wrapped_into(7.25F, 2.0F, 0.5F).periods, 3.0F);
  EXPECT_EQ(wrapped_into(-7.25F, 2.0F, 0.5F).at, 0.75F);
  EXPECT_EQ(wrapped_into(-7.25F, 2.0F, 0.5F).periods, -4.0F);
}

}  // namespace
}  // namespace sunfleck::shared

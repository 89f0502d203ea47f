#include "shared/beam.h"

#include "support/bvh_check.h"
#include "support/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace sunfleck::shared {
namespace {

using testing_bvh::Random;
using testing_bvh::uniform;

// Returns cells of 1 m x 1 m, so that a ray's place is its cell's number plus its jitter.
BeamBlock unit_cells(uint columns, uint rows) {
  BeamBlock beam{};
  beam.edge_u = {static_cast<float>(columns), 0, 0};
  beam.edge_v = {0, 0, static_cast<float>(rows)};
  beam.columns = columns;
  beam.rows = rows;
  beam.per_column = 1.0F / static_cast<float>(columns);
  beam.per_row = 1.0F / static_cast<float>(rows);
  beam.key = {5, 6};
  return beam;
}

TEST(BeamOrigin, TakesEveryCellOnce) {
  for (const auto& [columns, rows] :
       std::vector<std::pair<uint, uint>>{{1, 1}, {1, 7}, {7, 1}, {5, 3}, {4, 4}, {1000, 3}, {3, 1000}, {2, 5}, {13, 6}}) {
    const BeamBlock beam = unit_cells(columns, rows);
    std::vector<int> taken(columns * rows);
    for (uint ray = 0; ray < columns * rows; ++ray) {
      const vec3 origin = beam_origin(beam, ray);
      const uvec4 words = random_words(beam.key, ray, 0);
      const double column = static_cast<double>(origin.x) - static_cast<double>(unit_interval(words.x));
      const double row = static_cast<double>(origin.z) - static_cast<double>(unit_interval(words.y));
      const double tolerance = std::max(columns, rows) * 0x1p-22;  // the place is rounded four times
      EXPECT_NEAR(column, std::round(column), tolerance);
      EXPECT_NEAR(row, std::round(row), tolerance);
      ++taken.at(static_cast<std::size_t>(std::lround(column) + std::lround(row) * static_cast<long>(columns)));
    }
    EXPECT_EQ(std::count(taken.begin(), taken.end(), 1), static_cast<std::ptrdiff_t>(taken.size())) << columns << "x" << rows;
  }
}

TEST(BeamOrigin, StaysOnItsRectangle) {
  BeamBlock beam = unit_cells(50, 40);
  beam.corner = {1, 2, 3};
  beam.edge_u = {0.5F, 0.25F, 0};
  beam.edge_v = {0, 0.5F, -1};
  for (uint ray = 0; ray < 2'000; ++ray) {
    const vec3 at = beam_origin(beam, ray) - beam.corner;
    const float u = at.x / 0.5F;
    const float v = -at.z;
    EXPECT_TRUE(u >= 0.0F && u <= 1.0F && v >= 0.0F && v <= 1.0F);
    EXPECT_NEAR(at.y, 0.25F * u + 0.5F * v, 1e-6F);
  }
}

TEST(BeamOrigin, IsSpreadEvenlyWithinTheCells) {
  const BeamBlock beam = unit_cells(1024, 1024);
  std::vector<std::uint64_t> bins(32 * 32);
  for (uint ray = 0; ray < 1024 * 1024; ++ray) {
    const vec3 origin = beam_origin(beam, ray);
    const auto u = static_cast<std::size_t>(32.0F * (origin.x - std::floor(origin.x)));
    const auto v = static_cast<std::size_t>(32.0F * (origin.z - std::floor(origin.z)));
    ++bins[u * 32 + v];
  }
  test::expect_flat(bins, "place within the cell");
}

constexpr vec2 period(2.0F, 3.0F);
constexpr vec2 overlap(0x1p-10F, 0x1p-9F);

// Expects agreement to the reciprocal's two units in the last place and two roundings; zero is exact, and so are borders.
void expect_close(float got, float expected) {
  EXPECT_NEAR(got, expected, 0x1p-21F * std::abs(expected));
}
void expect_close(const vec3& got, const vec3& expected) {
  for (int axis = 0; axis < 3; ++axis) expect_close(got[axis], expected[axis]);
}

TEST(NextCrossing, OfRaysAlongAnAxis) {
  Ray ray = make_ray({0.5F, 9, 1}, {1, -1, 0});
  Crossing crossing = next_crossing(ray, period, overlap);
  EXPECT_TRUE(crossing.along_x);
  expect_close(crossing.t, 1.5F);
  expect_close(crossing.limit, 1.5F + overlap.x);
  expect_close(enter_next_period(ray, crossing, period), vec3(0, 7.5F, 1));

  ray = make_ray({0.5F, 9, 1}, {-1, -1, -0.0F});
  crossing = next_crossing(ray, period, overlap);
  EXPECT_TRUE(crossing.along_x);
  expect_close(crossing.t, 0.5F);
  expect_close(enter_next_period(ray, crossing, period), vec3(2, 8.5F, 1));

  ray = make_ray({0.5F, 9, 1}, {0, -1, 2});
  crossing = next_crossing(ray, period, overlap);
  EXPECT_FALSE(crossing.along_x);
  expect_close(crossing.t, 1.0F);
  expect_close(crossing.limit, 1.0F + 0.5F * overlap.y);
  expect_close(enter_next_period(ray, crossing, period), vec3(0.5F, 8, 0));

  ray = make_ray({0.5F, 9, 1}, {-0.0F, -1, -0.5F});
  crossing = next_crossing(ray, period, overlap);
  expect_close(crossing.t, 2.0F);
  expect_close(enter_next_period(ray, crossing, period), vec3(0.5F, 7, 3));
}

TEST(NextCrossing, OfAVerticalRayIsOutOfReach) {
  for (const float zero : {0.0F, -0.0F}) {
    const Crossing crossing = next_crossing(make_ray({0.5F, 9, 1}, {zero, -1, zero}), period, overlap);
    EXPECT_GT(crossing.t, 1e15F);
    EXPECT_GT(crossing.limit, 1e15F);
  }
}

TEST(NextCrossing, ThroughACornerTakesOneBorderAfterTheOther) {
  const vec2 square(1.0F, 1.0F);
  Ray ray = make_ray({0.5F, 9, 0.5F}, {1, -1, 1});
  Crossing crossing = next_crossing(ray, square, overlap);
  EXPECT_FALSE(crossing.along_x);
  expect_close(crossing.t, 0.5F);
  ray.origin = enter_next_period(ray, crossing, square);
  expect_close(ray.origin, vec3(1, 8.5F, 0));
  crossing = next_crossing(ray, square, overlap);
  EXPECT_TRUE(crossing.along_x);
  expect_close(crossing.t, 0.0F);
  EXPECT_GT(crossing.limit, 0.0F);
  ray.origin = enter_next_period(ray, crossing, square);
  expect_close(ray.origin, vec3(0, 8.5F, 0));
  expect_close(next_crossing(ray, square, overlap).t, 1.0F);
}

TEST(NextCrossing, OfARayOnTheBorderItLeavesIsAtOnce) {
  expect_close(next_crossing(make_ray({2, 9, 1}, {1, -1, 0}), period, overlap).t, 0.0F);
  expect_close(next_crossing(make_ray({0, 9, 1}, {-1, -1, 0}), period, overlap).t, 0.0F);
  expect_close(next_crossing(make_ray({2, 9, 1}, {-1, -1, 0}), period, overlap).t, 2.0F);
  expect_close(next_crossing(make_ray({0, 9, 1}, {-0.0F, -1, 0.5F}), period, overlap).t, 0.0F);
}

// Without wrapping, the ray stays where a straight line is; each crossing rounds three times, by less than 2^-23 of the sum.
TEST(NextCrossing, KeepsTheRayOnItsLine) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const glm::vec3 direction = testing_bvh::point(random, 1.0) - vec3(0, 1.5F, 0);
    const glm::dvec3 start(uniform(random, 0.0, 2.0), 50.0, uniform(random, 0.0, 3.0));
    Ray ray = make_ray(start, direction);
    glm::dvec3 moved(0.0);
    const glm::dvec3 first(ray.origin);
    double t = 0.0;
    constexpr int crossings = 100;
    for (int n = 0; n < crossings; ++n) {
      const Crossing crossing = next_crossing(ray, period, overlap);
      ASSERT_LE(crossing.t, crossing.limit);
      const vec3 next = enter_next_period(ray, crossing, period);
      ASSERT_TRUE(next.x >= 0.0F && next.x <= period.x && next.z >= 0.0F && next.z <= period.y);
      if (crossing.along_x) moved.x += direction.x > 0.0F ? period.x : -period.x;
      if (!crossing.along_x) moved.z += direction.z > 0.0F ? period.y : -period.y;
      t += static_cast<double>(crossing.t);
      ray.origin = next;
    }
    const glm::dvec3 line = first + t * glm::dvec3(direction);
    const glm::dvec3 off = glm::abs(glm::dvec3(ray.origin) + moved - line);
    const double tolerance = crossings * 3.0 * 0x1p-23 * std::max(50.0, std::abs(line.y));
    EXPECT_LE(std::max({off.x, off.y, off.z}), tolerance);
  }
}

GroundMap unit_ground() {
  GroundMap map{};
  map.plot_lo = {-1, 2};
  map.plot_hi = {3, 4};
  map.cells_x = 8;
  map.cells_z = 5;
  map.cells_per_metre = {2.0F, 2.5F};
  map.y = -0.5F;
  map.depth = 0.25F;
  return map;
}

TEST(MeetGround, IsAtTheGroundAndLooksALittleBelow) {
  const Ground ground = meet_ground(make_ray({0, 3.5F, 3}, {1, -2, 0.5F}), unit_ground());
  expect_close(ground.t, 2.0F);
  expect_close(ground.limit, 2.125F);
  EXPECT_EQ(ground_point(make_ray({0, 3.5F, 3}, {1, -2, 0.5F}), 2.0F), vec2(2, 4));
  EXPECT_EQ(meet_ground(make_ray({0, -0.6F, 3}, {1, -2, 0.5F}), unit_ground()).t, 0.0F);
}

TEST(InPlot, IncludesTheBorder) {
  const GroundMap map = unit_ground();
  for (const vec2 at : {vec2(-1, 2), vec2(3, 4), vec2(0, 3)}) EXPECT_TRUE(in_plot(map, at));
  for (const vec2 at : {vec2(-1.01F, 3), vec2(3.01F, 3), vec2(0, 1.99F), vec2(0, 4.01F)}) EXPECT_FALSE(in_plot(map, at));
}

// Down to twice the depth below the ground, which is what landings and the starts of packets need.
TEST(FallsOnPlot, OfRaysThatStartAboveTheGroundAlone) {
  const GroundMap map = unit_ground();
  const auto falls = [&](float y, float x) { return falls_on_plot(make_ray({x, y, 3}, {0.5F, -1, 0}), map); };
  for (const float y : {2.0F, -0.5F, -0.75F, -1.0F}) EXPECT_TRUE(falls(y, 0)) << y;
  for (const float y : {-1.01F, -2.0F}) EXPECT_FALSE(falls(y, 0)) << y;
  EXPECT_FALSE(falls(1.5F, 2.5F));  // meets the ground beside the plot
  EXPECT_TRUE(falls(-0.5F, 2.5F));
}

TEST(SoilCell, NumbersEveryCellFromItsMiddle) {
  const GroundMap map = unit_ground();
  for (uint z = 0; z < map.cells_z; ++z) {
    for (uint x = 0; x < map.cells_x; ++x) {
      const vec2 middle(-1.0F + 0.5F * (static_cast<float>(x) + 0.5F), 2.0F + 0.4F * (static_cast<float>(z) + 0.5F));
      EXPECT_EQ(soil_cell(map, middle), x + z * map.cells_x);
    }
  }
}

TEST(SoilCell, HoldsBordersAndWhatIsBeyond) {
  const GroundMap map = unit_ground();
  EXPECT_EQ(soil_cell(map, {-1, 2}), 0U);
  EXPECT_EQ(soil_cell(map, {3, 4}), 39U);
  EXPECT_EQ(soil_cell(map, {-7, -7}), 0U);
  EXPECT_EQ(soil_cell(map, {1e30F, 1e30F}), 39U);
  EXPECT_EQ(soil_cell(map, {-0.5F, 2}), 1U);
}

TEST(LayerOf, HoldsWhatIsOutsideInTheOutermostLayers) {
  EXPECT_EQ(layer_of(-5.0F, 0.0F, 4.0F, 20), 0U);
  EXPECT_EQ(layer_of(0.0F, 0.0F, 4.0F, 20), 0U);
  EXPECT_EQ(layer_of(0.25F, 0.0F, 4.0F, 20), 1U);
  EXPECT_EQ(layer_of(std::nextafter(0.25F, 0.0F), 0.0F, 4.0F, 20), 0U);
  EXPECT_EQ(layer_of(5.0F, 0.0F, 4.0F, 20), 19U);
  EXPECT_EQ(layer_of(1e30F, 0.0F, 4.0F, 20), 19U);
  EXPECT_EQ(layer_of(7.0F, 3.0F, 0.0F, 20), 0U);  // the canopy has no height
  EXPECT_EQ(layer_of(-0.5F, -1.0F, 4.0F, 20), 2U);
}

TEST(LandingY, StaysBetweenTheCorners) {
  EXPECT_EQ(landing_y(1, 2, 3, 0.0F, 0.0F), 1.0F);
  EXPECT_EQ(landing_y(1, 2, 3, 1.0F, 0.0F), 2.0F);
  EXPECT_EQ(landing_y(1, 2, 3, 0.0F, 1.0F), 3.0F);
  EXPECT_EQ(landing_y(1, 2, 3, 0.25F, 0.5F), 2.25F);
  EXPECT_EQ(landing_y(1, 2, 3, -0.5F, 0.0F), 1.0F);
  EXPECT_EQ(landing_y(3, 1, 2, 1.5F, 0.0F), 1.0F);
  EXPECT_EQ(landing_y(2, 3, 1, 1.5F, 0.5F), 3.0F);
  Random random(2);
  for (int k = 0; k < 10'000; ++k) {
    const glm::vec3 heights = testing_bvh::point(random, 1.0);
    const glm::vec3 weights = testing_bvh::point(random, 2.0);
    const float y = landing_y(heights.x, heights.y, heights.z, weights.x, weights.y);
    EXPECT_TRUE(y >= std::min({heights.x, heights.y, heights.z}) && y <= std::max({heights.x, heights.y, heights.z}));
  }
}

}  // namespace
}  // namespace sunfleck::shared

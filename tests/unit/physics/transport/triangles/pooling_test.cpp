#include "physics/transport/triangles/pooling.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sunfleck {
namespace {

constexpr std::size_t columns = 64;
constexpr std::size_t count = 2 * columns * columns;

// Two surfaces, one above the other, each a square of equal triangles.
Canopy two_squares() {
  std::vector<Triangle> corners;
  for (std::size_t k = 0; k < count; ++k) {
    const auto x = static_cast<float>(k % columns);
    const auto z = static_cast<float>(k / columns % columns);
    const float y = k < count / 2 ? 0.0F : 5.0F;
    corners.push_back({glm::vec3(x, y, z), glm::vec3(x + 1.0F, y, z), glm::vec3(x, y, z + 1.0F)});
  }
  Canopy canopy;
  canopy.corners = std::move(corners);
  return canopy;
}

std::vector<std::uint32_t> surface_numbers() {
  std::vector<std::uint32_t> numbers(count, 1);
  std::fill(numbers.begin(), numbers.begin() + count / 2, 0U);
  return numbers;
}

// Returns how many packets land if `expected` do on average (Knuth's method).
double landed(double expected, RandomStream& random) {
  const double end = std::exp(-expected);
  int packets = 0;
  for (double product = random.unit(); product > end; product *= random.unit()) ++packets;
  return packets;
}

class Pooling : public testing::Test {
 protected:
  Pooling() {
    for (std::uint64_t t = 0; t < 4; ++t) trees_.push_back(make_surface_tree(canopy_, surfaces_, weights_, t));
  }

  // Draws what lands in two halves of a run where `expected(element)` packets land on average in both together.
  template <class Expected>
  void land(const Expected& expected, std::uint64_t stream = 1) {
    RandomStream random(7, stream);
    for (std::size_t e = 0; e < count; ++e) {
      truth_[e] = expected(e);
      a_[e] = landed(0.5 * truth_[e], random);
      b_[e] = landed(0.5 * truth_[e], random);
    }
  }

  [[nodiscard]] PooledLight pooled(double noise = 1.0) const { return sunfleck::Pooling(trees_, weights_).pool(a_, b_, noise); }

  // Returns the root-mean-square error relative to the mean.
  [[nodiscard]] double error_of(const std::vector<double>& flux) const {
    double squares = 0.0, sum = 0.0;
    for (std::size_t e = 0; e < count; ++e) {
      squares += (flux[e] - truth_[e]) * (flux[e] - truth_[e]);
      sum += truth_[e];
    }
    return std::sqrt(squares * count) / sum;
  }
  [[nodiscard]] std::vector<double> raw() const {
    std::vector<double> sum(count);
    for (std::size_t e = 0; e < count; ++e) sum[e] = a_[e] + b_[e];
    return sum;
  }
  [[nodiscard]] double covered(const PooledLight& light) const {
    int times = 0;
    for (std::size_t e = 0; e < count; ++e) times += std::abs(light.flux[e] - truth_[e]) <= 1.96 * std::sqrt(light.variance[e]);
    return static_cast<double>(times) / static_cast<double>(count);
  }

  Canopy canopy_ = two_squares();
  std::vector<std::uint32_t> surfaces_ = surface_numbers();
  std::vector<double> weights_ = std::vector<double>(count, 0.5);
  std::vector<SurfaceTree> trees_;
  std::vector<double> truth_ = std::vector<double>(count), a_ = truth_, b_ = truth_;
};

double waves(std::size_t e) {
  const std::size_t row = e / columns;
  return 8.0 + 4.0 * std::sin(0.15 * static_cast<double>(e % columns)) * std::cos(0.1 * static_cast<double>(row));
}

TEST_F(Pooling, RemovesNoiseFromEvenLight) {
  land([](std::size_t) { return 4.0; });
  EXPECT_GT(error_of(raw()), 0.45);
  EXPECT_LT(error_of(pooled().flux), 0.05);
}

TEST_F(Pooling, FollowsLightThatChangesSlowly) {
  land(waves);
  const PooledLight light = pooled();
  EXPECT_LT(error_of(light.flux), 0.4 * error_of(raw()));
  EXPECT_GE(covered(light), 0.92);
  double variance = 0.0, squares = 0.0;
  for (std::size_t e = 0; e < count; ++e) {
    variance += light.variance[e];
    squares += (light.flux[e] - truth_[e]) * (light.flux[e] - truth_[e]);
  }
  EXPECT_LT(variance, 2.0 * squares);
}

TEST_F(Pooling, KeepsTheEdgeOfAShadow) {
  land([](std::size_t e) { return e % columns < 37 ? 20.0 : 1.0; });
  const PooledLight light = pooled();
  EXPECT_LT(error_of(light.flux), 0.6 * error_of(raw()));
  EXPECT_GE(covered(light), 0.92);
  for (std::size_t row = 3; row < 60; row += 8) {
    EXPECT_GT(light.flux[row * columns + 30], 12.0);
    EXPECT_LT(light.flux[row * columns + 44], 4.0);
  }
}

TEST_F(Pooling, KeepsTheFluxOfEachSurface) {
  land([](std::size_t e) { return e < count / 2 ? 3.0 : 9.0; });
  const PooledLight light = pooled();
  const auto half = static_cast<std::ptrdiff_t>(count / 2);
  const std::vector<double> seen = raw();
  const double lower = std::accumulate(seen.begin(), seen.begin() + half, 0.0);
  const double upper = std::accumulate(seen.begin() + half, seen.end(), 0.0);
  EXPECT_NEAR(std::accumulate(light.flux.begin(), light.flux.begin() + half, 0.0), lower, 1e-9 * lower);
  EXPECT_NEAR(std::accumulate(light.flux.begin() + half, light.flux.end(), 0.0), upper, 1e-9 * upper);
}

TEST_F(Pooling, LeavesElementsWithoutWeightAlone) {
  weights_[5] = 0.0;
  trees_ = {make_surface_tree(canopy_, surfaces_, weights_, 0)};
  land([](std::size_t e) { return e == 5 ? 0.0 : 4.0; });
  a_[5] = 17.0;
  const PooledLight light = pooled();
  EXPECT_EQ(light.flux[5], 17.0);
  EXPECT_EQ(light.variance[5], 0.0);
}

TEST_F(Pooling, OfADarkSurfaceKnowsThatLittleMayHaveBeenMissed) {
  land([](std::size_t e) { return e < count / 2 ? 0.0 : 9.0; });
  const PooledLight light = pooled();
  EXPECT_EQ(light.flux[0], 0.0);
  double deviations = 0.0;
  for (std::size_t e = 0; e < count / 2; ++e) deviations += std::sqrt(light.variance[e]);
  // Up to 3.69 packets of one quantum may have escaped; their number is known to a few percent from the noise.
  EXPECT_NEAR(1.96 * deviations, 3.69, 0.4);
}

// Some light may have been missed, as much as a few packets carry.
TEST_F(Pooling, OfNoLightAtAllIsDark) {
  for (const double packet : {0.0, 2.0}) {
    const PooledLight light = pooled(packet);
    EXPECT_EQ(*std::max_element(light.flux.begin(), light.flux.end()), 0.0);
    double deviation = 0.0;
    for (std::size_t e = 0; e < count / 2; ++e) deviation += std::sqrt(light.variance[e]);
    EXPECT_NEAR(1.96 * deviation, 3.69 * packet, 0.01 * packet) << "of the first surface";
  }
}

// Nothing but the noise that is given tells how well a surface without parts is known.
TEST_F(Pooling, SurfacesOfOneElementHaveTheNoiseOfTheirFlux) {
  std::iota(surfaces_.begin(), surfaces_.end(), 0U);
  trees_ = {make_surface_tree(canopy_, surfaces_, weights_, 0)};
  land([](std::size_t) { return 9.0; });
  const PooledLight light = pooled();
  EXPECT_EQ(light.flux, raw());
  const double held = covered(light);
  EXPECT_GT(held, 0.92);
  EXPECT_LT(held, 0.97);
}

TEST_F(Pooling, ElementsOfVeryDifferentSizeStayFinite) {
  for (std::size_t e = 0; e < count; e += 3) weights_[e] = 1e-30;
  trees_ = {make_surface_tree(canopy_, surfaces_, weights_, 0)};
  land([](std::size_t e) { return e % 3 == 0 ? 0.0 : 4.0; });
  for (const double flux : pooled().flux) ASSERT_TRUE(std::isfinite(flux));
  for (const double variance : pooled().variance) ASSERT_TRUE(std::isfinite(variance));
}

TEST_F(Pooling, TreesHoldEachElementOnceAndNest) {
  const SurfaceTree& tree = trees_.front();
  std::vector<int> times(count);
  for (const std::uint32_t e : tree.order) ++times[e];
  EXPECT_EQ(*std::min_element(times.begin(), times.end()), 1);
  ASSERT_EQ(tree.surfaces.size(), 2U);
  EXPECT_EQ(tree.cuts.size(), count - 2);
  std::vector<TreeRange> open(tree.surfaces.begin(), tree.surfaces.end());
  for (const TreeCut& cut : tree.cuts) {
    const auto found = std::find_if(open.begin(), open.end(), [&](const TreeRange& range) {
      return range.begin == cut.whole.begin && range.end == cut.whole.end;
    });
    ASSERT_NE(found, open.end());
    open.erase(found);
    for (const TreeRange& part : {TreeRange{cut.whole.begin, cut.middle}, TreeRange{cut.middle, cut.whole.end}}) {
      ASSERT_GE(part.size(), 1U);
      ASSERT_LE(3 * part.size(), 2 * cut.whole.size() + 3);
      if (part.size() > 1) open.push_back(part);
    }
  }
  EXPECT_TRUE(open.empty());
}

}  // namespace
}  // namespace sunfleck

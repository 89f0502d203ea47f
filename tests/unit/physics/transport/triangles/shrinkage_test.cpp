#include "physics/transport/triangles/shrinkage.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace sunfleck {
namespace {

// Returns a normally distributed number (Box and Muller).
double normal(RandomStream& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) * std::cos(2.0 * std::numbers::pi * random.unit());
}

struct Sample {
  std::vector<double> truth, seen, noise;
};

// Returns differences of which every tenth is large and the others are 0, seen through noise.
Sample few_large_ones(std::size_t size, double large, double noise_deviation) {
  RandomStream random(1, 2);
  Sample sample;
  for (std::size_t k = 0; k < size; ++k) {
    sample.truth.push_back(k % 10 == 0 ? large * normal(random) : 0.0);
    sample.seen.push_back(sample.truth.back() + noise_deviation * normal(random));
    sample.noise.push_back(noise_deviation * noise_deviation);
  }
  return sample;
}

double mean_square_error(const Sample& sample, const Shrinkage& shrinkage) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sample.seen.size(); ++k) {
    const double off = shrinkage.of(sample.seen[k], sample.noise[k]).mean - sample.truth[k];
    sum += off * off;
  }
  return sum / static_cast<double>(sample.seen.size());
}

TEST(Shrinkage, TakesNoiseForNoise) {
  const Sample sample = few_large_ones(2000, 0.0, 0.1);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  EXPECT_LT(mean_square_error(sample, shrinkage), 0.02 * 0.1 * 0.1);
  EXPECT_LT(std::abs(shrinkage.of(0.1, 0.01).mean), 0.02);
}

TEST(Shrinkage, KeepsTheFewTrueDifferences) {
  const Sample sample = few_large_ones(4000, 0.5, 0.05);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  // The best linear estimate keeps one share of all differences: 0.025 / (0.025 + 0.0025) of them, which leaves 0.0023.
  EXPECT_LT(mean_square_error(sample, shrinkage), 0.0008);
  EXPECT_NEAR(shrinkage.of(0.8, 0.0025).mean, 0.8, 0.03);
  EXPECT_LT(std::abs(shrinkage.of(0.05, 0.0025).mean), 0.02);
}

TEST(Shrinkage, KnowsItsError) {
  const Sample sample = few_large_ones(4000, 0.3, 0.1);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  double variance = 0.0;
  for (std::size_t k = 0; k < sample.seen.size(); ++k) variance += shrinkage.of(sample.seen[k], sample.noise[k]).variance;
  // The mean of 4,000 squares, most of them tiny, has a standard error of 8 %; the mixture is coarser than the truth.
  EXPECT_NEAR(variance / 4000.0 / mean_square_error(sample, shrinkage), 1.0, 0.3);
}

TEST(Shrinkage, SaysWhatIsLikelyWhereNothingWasSeen) {
  const Sample sample = few_large_ones(4000, 0.5, 0.05);
  const Posterior posterior = Shrinkage(sample.seen, sample.noise).of(0.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(posterior.mean, 0.0);
  EXPECT_NEAR(posterior.variance, 0.1 * 0.25, 0.01);
}

TEST(Shrinkage, OfNothingSeenIsFinite) {
  const Shrinkage shrinkage({}, {});
  EXPECT_LT(std::abs(shrinkage.of(0.3, 0.01).mean), 0.3);
  EXPECT_TRUE(std::isfinite(shrinkage.of(0.3, 0.0).variance));
}

}  // namespace
}  // namespace sunfleck

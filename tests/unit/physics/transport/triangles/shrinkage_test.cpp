#include "physics/transport/triangles/shrinkage.h"

#include "base/random.h"
#include "support/processor_kinds.h"

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

struct Shrunk {
  double mean, variance;
};

Shrunk shrunk(const Shrinkage& shrinkage, double difference, double noise) {
  shrinkage.shrink({&difference, 1}, {&noise, 1});
  return {difference, noise};
}

double mean_square_error(const Sample& sample, const Shrinkage& shrinkage) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sample.seen.size(); ++k) {
    const double off = shrunk(shrinkage, sample.seen[k], sample.noise[k]).mean - sample.truth[k];
    sum += off * off;
  }
  return sum / static_cast<double>(sample.seen.size());
}

TEST(Shrinkage, TakesNoiseForNoise) {
  const Sample sample = few_large_ones(2000, 0.0, 0.1);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  EXPECT_LT(mean_square_error(sample, shrinkage), 0.02 * 0.1 * 0.1);
  EXPECT_LT(std::abs(shrunk(shrinkage, 0.1, 0.01).mean), 0.02);
}

TEST(Shrinkage, KeepsTheFewTrueDifferences) {
  const Sample sample = few_large_ones(4000, 0.5, 0.05);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  // The best linear estimate keeps one share of all differences: 0.025 / (0.025 + 0.0025) of them, which leaves 0.0023.
  EXPECT_LT(mean_square_error(sample, shrinkage), 0.0008);
  EXPECT_NEAR(shrunk(shrinkage, 0.8, 0.0025).mean, 0.8, 0.03);
  EXPECT_LT(std::abs(shrunk(shrinkage, 0.05, 0.0025).mean), 0.02);
}

TEST(Shrinkage, KnowsItsError) {
  const Sample sample = few_large_ones(4000, 0.3, 0.1);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  double variance = 0.0;
  for (std::size_t k = 0; k < sample.seen.size(); ++k) variance += shrunk(shrinkage, sample.seen[k], sample.noise[k]).variance;
  // The mean of 4,000 squares, most of them tiny, has a standard error of 8 %; the mixture is coarser than the truth.
  EXPECT_NEAR(variance / 4000.0 / mean_square_error(sample, shrinkage), 1.0, 0.3);
}

TEST(Shrinkage, SaysWhatIsLikelyWhereNothingWasSeen) {
  const Sample sample = few_large_ones(4000, 0.5, 0.05);
  const Shrinkage shrinkage(sample.seen, sample.noise);
  const Shrunk unseen = shrunk(shrinkage, 0.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(unseen.mean, 0.0);
  EXPECT_NEAR(unseen.variance, 0.1 * 0.25, 0.01);
}

TEST(Shrinkage, OfNothingSeenIsFinite) {
  const Shrinkage shrinkage({}, {});
  EXPECT_LT(std::abs(shrunk(shrinkage, 0.3, 0.01).mean), 0.3);
  EXPECT_TRUE(std::isfinite(shrunk(shrinkage, 0.3, 0.0).variance));
}

// The formulas, one difference after the other.
class Plain {
 public:
  Plain() { shares_.fill(1.0 / 9.0); }

  explicit Plain(const Sample& sample) : Plain() {
    for (int step = 0; step < 30; ++step) {
      Shrinkage::Values sums{};
      for (std::size_t i = 0; i < sample.seen.size(); ++i) {
        const Shrinkage::Values parts = parts_of(sample.seen[i], sample.noise[i]);
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += parts[k];
      }
      for (std::size_t k = 0; k < sums.size(); ++k) {
        shares_[k] = (sums[k] + 4.0 / 9.0) / (static_cast<double>(sample.seen.size()) + 4.0);
      }
    }
  }

  [[nodiscard]] Shrunk of(double difference, double noise) const {
    const Shrinkage::Values parts = parts_of(difference, noise);
    double mean = 0.0, square = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double kept = Shrinkage::variances[k] / (Shrinkage::variances[k] + noise);
      mean += parts[k] * kept * difference;
      square += parts[k] * (kept * difference * kept * difference + kept * noise);
    }
    return {mean, square - mean * mean};
  }

 private:
  // Returns how likely the difference comes from each component.
  [[nodiscard]] Shrinkage::Values parts_of(double difference, double noise) const {
    Shrinkage::Values parts;
    double sum = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double variance = Shrinkage::variances[k] + noise;
      const double less_likely = 0.5 * difference * difference * (1.0 / variance - 1.0 / (1.0 + noise));
      sum += parts[k] = shares_[k] / std::sqrt(variance) * std::exp(-less_likely);
    }
    for (double& part : parts) part /= sum;
    return parts;
  }

  Shrinkage::Values shares_;
};

void expect_same(const Shrunk& shrunk, const Shrunk& plain) {
  EXPECT_NEAR(shrunk.mean, plain.mean, 1e-13 + 1e-11 * std::abs(plain.mean));
  EXPECT_NEAR(shrunk.variance, plain.variance, 1e-13 + 1e-11 * plain.variance);
}

TEST(Shrinkage, FollowsTheFormulasWithEqualShares) {
  const Shrinkage shrinkage({}, {});
  for (const double difference : {0.0, 1e-6, -0.003, 0.05, -0.4, 1.0, -7.0}) {
    for (const double noise : {1e-12, 1e-9, 1e-6, 0.001, 0.1, 1.0, 1e3, 1e9}) {
      SCOPED_TRACE(testing::Message() << difference << " with noise " << noise);
      expect_same(shrunk(shrinkage, difference, noise), Plain().of(difference, noise));
    }
  }
}

TEST(Shrinkage, LearnsSharesByTheFormulas) {
  for (const std::size_t size : {1U, 7U, 8U, 9U, 1003U}) {
    const Sample sample = few_large_ones(size, 0.5, 0.05);
    const Shrinkage shrinkage(sample.seen, sample.noise);
    const Plain plain(sample);
    for (const double difference : {0.001, 0.1, -0.7}) {
      SCOPED_TRACE(testing::Message() << difference << ", learned from " << size);
      expect_same(shrunk(shrinkage, difference, 0.0025), plain.of(difference, 0.0025));
    }
  }
}

TEST(Shrinkage, HasTheSameBitsOnEveryKindOfProcessor) {
  Sample sample = few_large_ones(1003, 0.5, 0.05);
  for (std::size_t k = 5; k < sample.noise.size(); k += 7) sample.noise[k] = std::numeric_limits<double>::infinity();
  const auto shrunk_sample = [&] {
    Sample shrunk = sample;
    Shrinkage(sample.seen, sample.noise).shrink(shrunk.seen, shrunk.noise);
    return shrunk;
  };
  const Sample here = shrunk_sample();
  EXPECT_NE(here.seen, sample.seen);
  test::for_each_processor_kind([&] {
    const Sample there = shrunk_sample();
    EXPECT_EQ(there.seen, here.seen);
    EXPECT_EQ(there.noise, here.noise);
  });
}

}  // namespace
}  // namespace sunfleck

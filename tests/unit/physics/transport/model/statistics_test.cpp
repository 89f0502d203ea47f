#include "physics/transport/model/statistics.h"

#include "support/bvh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace sunfleck {
namespace {

// Critical values of Student's t as printed in tables (e.g. NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2).
TEST(TQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(t_quantile(0.95, 2), 12.706, 5e-4);
  EXPECT_NEAR(t_quantile(0.95, 8), 2.365, 5e-4);
  EXPECT_NEAR(t_quantile(0.95, 16), 2.131, 5e-4);
  EXPECT_NEAR(t_quantile(0.95, 31), 2.042, 5e-4);
  EXPECT_NEAR(t_quantile(0.90, 5), 2.132, 5e-4);
  EXPECT_NEAR(t_quantile(0.99, 10), 3.250, 5e-4);
  EXPECT_NEAR(t_quantile(0.998, 11), 4.143, 1e-3);
  EXPECT_NEAR(t_quantile(0.95, 1'000'001), 1.960, 5e-4);
}

TEST(TQuantile, IsUnknownBelowTwoReplicates) {
  EXPECT_TRUE(std::isnan(t_quantile(0.95, 0)));
  EXPECT_TRUE(std::isnan(t_quantile(0.95, 1)));
}

// Garwood's upper limits when no event was seen: 2.996 at 90 %, 3.689 at 95 %, 5.298 at 99 %.
TEST(UnseenEvents, AreThoseOfTheTables) {
  EXPECT_NEAR(unseen_events(0.90), 2.996, 5e-4);
  EXPECT_NEAR(unseen_events(0.95), 3.689, 5e-4);
  EXPECT_NEAR(unseen_events(0.99), 5.298, 5e-4);
}

TEST(ReplicateMean, HasAnIntervalOfAtLeastWhatMayBeUnseen) {
  ReplicateMean mean;
  mean.add(0.25);
  EXPECT_TRUE(std::isnan(mean.estimate(2.0, 0.1).half_width));
  EXPECT_TRUE(std::isnan(mean.estimate(2.0, std::numeric_limits<double>::infinity()).half_width));
  for (int k = 0; k < 7; ++k) mean.add(0.25);
  EXPECT_EQ(mean.estimate(2.0, 0.1).half_width, 0.1);
  EXPECT_EQ(mean.estimate(2.0).half_width, 0.0);
  mean.add(0.5);
  EXPECT_EQ(mean.estimate(2.0, 0.1).half_width, mean.estimate(2.0).half_width) << "all replicates saw much";
  for (int k = 0; k < 8; ++k) mean.add(0.0);
  EXPECT_EQ(mean.estimate(2.0, 0.1).half_width, mean.estimate(2.0).half_width) << "fewer than half saw nothing";
  mean.add(0.0);
  EXPECT_EQ(mean.estimate(2.0, 0.1).half_width, 0.1) << "half saw nothing";
  EXPECT_EQ(mean.estimate(2.0, 0.01).half_width, mean.estimate(2.0).half_width) << "their spread is larger";
}

TEST(ReplicateMean, OfAnAreaAllowsForWhatNoRayMet) {
  ReplicateMean mean;
  for (int k = 0; k < 16; ++k) mean.add(0.5 + (k % 2 == 0 ? 0.001 : -0.001));
  const double spread = mean.estimate(2.0).half_width;
  EXPECT_EQ(mean.estimate_of_area(2.0, 2.9 * spread, 1.0).half_width, spread) << "no more than the spread may hide";
  EXPECT_EQ(mean.estimate_of_area(2.0, 0.4, 1.0).half_width, 0.4);
  EXPECT_NEAR(mean.estimate_of_area(2.0, 0.4, 10.0).half_width, 0.4 * 2.0 * 0.5 / 9.6, 1e-12) << "little of the rest is sunlit";
  EXPECT_EQ(mean.estimate_of_area(2.0, 0.4, 1.0).value, mean.mean());
}

// A surface that few packets reach, some of which carry much and others little: where only faint ones came, their spread is small.
// At least 95 % of 4,000 intervals must hold, within three standard errors; without what may be unseen 22 to 65 % do while
// fewer than five are expected.
TEST(ReplicateMean, OfFewUnequalEventsHasAnIntervalThatHolds) {
  constexpr int runs = 4'000;
  constexpr int replicates = 16;
  for (const double expected_events : {0.5, 1.0, 2.0, 5.0, 20.0}) {
    testing_bvh::Random random(3);
    const double chance = expected_events / replicates;  // of an event in a replicate
    int held = 0, held_by_spread = 0;
    for (int run = 0; run < runs; ++run) {
      ReplicateMean mean;
      for (int k = 0; k < replicates; ++k) {
        double light = 0.0;
        for (int half = 0; half < 2; ++half) {  // bright events, then faint ones
          if (testing_bvh::uniform(random) < 0.5 * chance) light += half == 0 ? 1.0 : 0.01;
        }
        mean.add(light);
      }
      const double truth = 0.5 * chance * 1.01;
      const auto holds = [&](const Estimate& estimate) { return std::abs(estimate.value - truth) <= estimate.half_width; };
      held += holds(mean.estimate(t_quantile(0.95, replicates), unseen_events(0.95) / replicates)) ? 1 : 0;
      held_by_spread += holds(mean.estimate(t_quantile(0.95, replicates))) ? 1 : 0;
    }
    const double error = std::sqrt(0.95 * 0.05 / runs);
    EXPECT_GE(held, (0.95 - 3.0 * error) * runs) << expected_events;
    if (expected_events < 5.0) {
      EXPECT_LT(held_by_spread, 0.8 * runs) << expected_events;
    }
  }
}

TEST(ReplicateMean, IsUnknownBelowTwoReplicates) {
  ReplicateMean mean;
  EXPECT_EQ(mean.count(), 0U);
  EXPECT_TRUE(std::isnan(mean.standard_error()));
  mean.add(3.0);
  EXPECT_EQ(mean.mean(), 3.0);
  EXPECT_TRUE(std::isnan(mean.standard_error()));
  mean.add(5.0);
  EXPECT_EQ(mean.mean(), 4.0);
  EXPECT_EQ(mean.standard_error(), 1.0);  // the deviation sqrt(2) over sqrt(2)
}

// This must hold far from zero too, where the difference of sums of squares would lose every digit.
TEST(ReplicateMean, AgreesWithTwoPasses) {
  for (const double offset : {0.0, 1e9}) {
    testing_bvh::Random random(1);
    std::vector<double> values;
    ReplicateMean running;
    for (int k = 0; k < 1'000; ++k) {
      values.push_back(offset + testing_bvh::uniform(random));
      running.add(values.back());
    }
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 1e3;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    EXPECT_EQ(running.count(), 1'000U);
    EXPECT_NEAR(running.mean(), mean, 1e-12 * (1.0 + offset));
    EXPECT_NEAR(running.standard_error(), std::sqrt(squares / 999.0 / 1e3), 1e-9);
    EXPECT_DOUBLE_EQ(running.estimate(2.0).half_width, 2.0 * running.standard_error());
    EXPECT_EQ(running.estimate(2.0).value, running.mean());
  }
}

TEST(ReplicateMean, OfEqualValuesHasNoError) {
  ReplicateMean mean;
  for (int k = 0; k < 100; ++k) mean.add(0.1);
  EXPECT_EQ(mean.mean(), 0.1);
  EXPECT_EQ(mean.standard_error(), 0.0);
}

TEST(Estimate, ScalesWithAHalfWidthThatStaysPositive) {
  const Estimate scaled = Estimate{2.0, 0.5}.scaled(-3.0);
  EXPECT_EQ(scaled.value, -6.0);
  EXPECT_EQ(scaled.half_width, 1.5);
}

}  // namespace
}  // namespace sunfleck

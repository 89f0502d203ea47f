#include "physics/transport/solve/foresight.h"

#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/statistics.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(Completion, GrowsWithTheWorkWhereTheExpectationStays) {
  Completion completion;
  for (int done = 1; done <= 20; ++done) EXPECT_NEAR(completion.update(done, 20), done / 20.0, 1e-12);
}

TEST(Completion, NeverGoesBackHoweverTheExpectationChanges) {
  Completion completion;
  double last = 0.0;
  // Expectations of the pilots and checks: first too low, then far higher, then lower again.
  const double expected[] = {16, 16, 12, 12, 24, 40, 200, 180, 190, 60, 60, 30, 30, 30, 28};
  for (std::size_t done = 1; done <= std::size(expected); ++done) {
    const double fraction = completion.update(static_cast<double>(done), expected[done - 1]);
    EXPECT_GT(fraction, last);
    EXPECT_LT(fraction, 1.0);
    last = fraction;
  }
  EXPECT_EQ(completion.update(28, 28), 1.0);
}

// An expectation that keeps moving away still leaves room: the progress does not stay near its end.
TEST(Completion, LeavesRoomForWorkThatWasNotForeseen) {
  Completion completion;
  double at_12 = 0.0;
  for (int done = 1; done <= 12; ++done) at_12 = completion.update(done, 16);
  EXPECT_NEAR(at_12, 0.75, 1e-12);
  for (int done = 13; done <= 100; ++done) EXPECT_LT(completion.update(done, done + 40), 0.99);
}

TEST(ReplicatesNeeded, FollowTheSquareOfTheError) {
  EXPECT_EQ(replicates_needed(0.01, 0.02, 0.95, 16, 65536), 16U);
  // Four times as many, reduced by the fall of Student's quantile meanwhile.
  const std::size_t needed = replicates_needed(0.02, 0.01, 0.95, 16, 65536);
  const double quantiles = t_quantile(0.95, needed) / t_quantile(0.95, 16);
  EXPECT_NEAR(static_cast<double>(needed), 64.0 * quantiles * quantiles, 1.0);
  EXPECT_EQ(replicates_needed(1.0, 1e-9, 0.95, 16, 65536), 65536U);
  EXPECT_EQ(replicates_needed(0.0, 1e-9, 0.95, 2, 65536), 2U);
}

TEST(CheckAfter, ComesCloserToWhatIsNeeded) {
  EXPECT_EQ(check_after(12, 13, ErrorTarget::canopy), 14U);
  EXPECT_EQ(check_after(12, 16, ErrorTarget::canopy), 14U);
  EXPECT_EQ(check_after(12, 40, ErrorTarget::organ), 26U);
  EXPECT_EQ(check_after(200, 200, ErrorTarget::canopy), 202U);
  EXPECT_EQ(check_after(most_replicates - 1, most_replicates, ErrorTarget::canopy), most_replicates);
}

TEST(CheckAfter, IsRareForTriangles) {
  EXPECT_EQ(check_after(12, 13, ErrorTarget::triangle), 16U);
  EXPECT_EQ(check_after(64, 66, ErrorTarget::triangle), 72U);
  EXPECT_EQ(check_after(64, 128, ErrorTarget::triangle), 96U);
}

}  // namespace
}  // namespace sunfleck

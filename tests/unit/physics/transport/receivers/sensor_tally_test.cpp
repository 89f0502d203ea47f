#include "physics/transport/receivers/sensor_tally.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunfleck {
namespace {

constexpr double confidence = 0.95;

// Returns the result of eight replicates whose sky light is 3 + d and whose scattered light is 2 + slope * d, d = -1 or 1.
SensorResult two_parts(double slope) {
  SensorTally tally({{5.0}, {}}, {1.0});
  for (int r = 0; r < 8; ++r) {
    const double d = r % 2 == 0 ? -1.0 : 1.0;
    tally.add({3.0 + d, {2.0 + slope * d}});
  }
  EXPECT_EQ(tally.replicates(), 8U);
  const SampledLight unseen = tally.unseen({0.5, {0.25}});
  EXPECT_EQ(unseen.sky, 0.0) << "the spread tells the error";
  return tally.result(unseen, confidence);
}

// The error of a total is not that of independent parts: parts that vary together add up, parts that vary against each other
// cancel.
TEST(SensorTally, TheErrorOfATotalIsThatOfTheSum) {
  const double of_one = t_quantile(confidence, 8) / std::sqrt(7.0);
  const SensorResult together = two_parts(1.0), against = two_parts(-1.0);
  for (const SensorResult& result : {together, against}) {
    EXPECT_NEAR(result.total[0].value, 10.0, 1e-12);
    EXPECT_EQ(result.direct[0].half_width, 0.0);
    EXPECT_NEAR(result.sky[0].half_width, of_one, 1e-12);
    EXPECT_NEAR(result.scattered[0].half_width, of_one, 1e-12);
  }
  EXPECT_NEAR(together.total[0].half_width, 2.0 * of_one, 1e-12);
  EXPECT_NEAR(against.total[0].half_width, 0.0, 1e-12);
}

TEST(SensorTally, AgreementMayHideRareLight) {
  SensorTally tally({{0.0}, {}}, {100.0});
  for (int r = 0; r < 8; ++r) tally.add({0.0, {r % 2 == 0 ? 1.0 : 3.0}});
  const SampledLight unseen = tally.unseen({0.5, {0.25}});
  EXPECT_EQ(unseen.sky, 0.5);
  EXPECT_EQ(unseen.scattered[0], 0.0);
  const SensorResult result = tally.result(unseen, confidence);
  const double rare = unseen_events(confidence) * 0.5 * 100.0 / 8.0, spread = t_quantile(confidence, 8) / std::sqrt(7.0);
  EXPECT_EQ(result.sky[0].value, 0.0);
  EXPECT_NEAR(result.sky[0].half_width, rare, 1e-12);
  EXPECT_NEAR(result.scattered[0].half_width, spread, 1e-12);
  EXPECT_NEAR(result.total[0].half_width, std::hypot(rare, spread), 1e-12);
}

TEST(SensorTally, LightOfListedDirectionsIsExact) {
  SensorTally tally({{1.0}, 0.25}, {100.0});
  for (int r = 0; r < 8; ++r) tally.add({0.0, {0.0}});
  const SensorResult result = tally.result(tally.unseen({0.5, {0.0}}), confidence);
  EXPECT_EQ(result.sky[0].value, 25.0);
  EXPECT_EQ(result.sky[0].half_width, 0.0);
  EXPECT_EQ(result.total[0].value, 26.0);
  EXPECT_EQ(result.total[0].half_width, 0.0);
}

}  // namespace
}  // namespace sunfleck

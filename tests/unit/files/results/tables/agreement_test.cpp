#include "files/results/tables/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sunfleck {
namespace {

// Computed by hand: means 0.5 and 0.4; deviations of measured -0.3, -0.1, 0.1, 0.3 (squares 0.2), of simulated -0.2, -0.2, 0.1,
// 0.3 (squares 0.18); products 0.06 + 0.02 + 0.01 + 0.09 = 0.18; differences -0.0, -0.2, -0.1, -0.1 (squares 0.06).
TEST(AgreementFigures, AreThoseComputedByHand) {
  const std::vector<double> measured{0.2, 0.4, 0.6, 0.8};
  const std::vector<double> simulated{0.2, 0.2, 0.5, 0.7};
  const Agreement got = agreement(simulated, measured);
  EXPECT_EQ(got.n, 4U);
  EXPECT_NEAR(got.slope, 0.18 / 0.2, 1e-12);
  EXPECT_NEAR(got.intercept, 0.4 - 0.9 * 0.5, 1e-12);
  EXPECT_NEAR(got.r2, 0.18 * 0.18 / (0.2 * 0.18), 1e-12);
  EXPECT_NEAR(got.rmse, std::sqrt(0.06 / 4.0), 1e-12);
  EXPECT_EQ(agreement_line("field.csv", got), "agreement with field.csv: n 4, R2 0.900, RMSE 0.122, slope 0.900");
}

TEST(AgreementFigures, OfEqualAndOfOppositeValues) {
  const std::vector<double> values{0.1, 0.3, 0.9};
  const Agreement same = agreement(values, values);
  EXPECT_DOUBLE_EQ(same.r2, 1.0);
  EXPECT_DOUBLE_EQ(same.slope, 1.0);
  EXPECT_EQ(same.rmse, 0.0);
  const std::vector<double> opposite{0.9, 0.7, 0.1};
  const Agreement against = agreement(opposite, values);
  EXPECT_NEAR(against.r2, 1.0, 1e-12);
  EXPECT_NEAR(against.slope, -1.0, 1e-12);
  EXPECT_NEAR(against.intercept, 1.0, 1e-12);
}

TEST(AgreementFigures, AreUndefinedWhereNothingVaries) {
  const std::vector<double> one{0.5}, other{0.25};
  const Agreement single = agreement(one, other);
  EXPECT_TRUE(std::isnan(single.r2) && std::isnan(single.slope) && std::isnan(single.intercept));
  EXPECT_DOUBLE_EQ(single.rmse, 0.25);
  EXPECT_EQ(agreement_line("a\nb", single), "agreement with a?b: n 1, R2 undefined, RMSE 0.250, slope undefined");
  const Agreement flat = agreement(std::vector<double>{0.5, 0.5}, std::vector<double>{0.2, 0.8});
  EXPECT_TRUE(std::isnan(flat.r2));
  EXPECT_EQ(flat.slope, 0.0);
}

TEST(AgreementFigures, RefuseListsThatDoNotMatch) {
  EXPECT_THROW(static_cast<void>(agreement(std::vector<double>{1.0}, std::vector<double>{})), std::logic_error);
  EXPECT_THROW(static_cast<void>(agreement(std::vector<double>{}, std::vector<double>{})), std::logic_error);
}

}  // namespace
}  // namespace sunfleck

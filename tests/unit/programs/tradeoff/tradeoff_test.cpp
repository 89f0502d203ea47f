#include "base/units.h"
#include "files/results/tables/tradeoff_table.h"
#include "programs/tradeoff/tradeoff_error.h"
#include "programs/tradeoff/tradeoff_fit.h"
#include "programs/tradeoff/tradeoff_plan.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunfleck {
namespace {

std::size_t number(Quantity quantity) {
  return static_cast<std::size_t>(quantity);
}

// Returns two parts around the organs' values 10 and 40, and a third value that is not judged.
TradeoffReference organ_reference(double spread) {
  TradeoffReference reference;
  for (const double sign : {-1.0, 1.0}) {
    RunValues part;
    part[number(Quantity::organ)].value = {10.0 + sign * spread, 40.0, 1000.0 * sign};
    reference.add(part);
  }
  RunNorms norms;
  norms[number(Quantity::organ)] = {{1.0, 1.0, 0.0}, {10.0, 40.0, 1.0}};
  reference.judge_by(norms);
  return reference;
}

TEST(TradeoffError, IsTheRootMeanSquareOfRelativeErrors) {
  const TradeoffReference reference = organ_reference(0.0);
  // The values are off by 3 % and 4 %, with half-widths of 5 % and 2 %: only the first is covered.
  const QuantityValues run{{10.3, 38.4, 5.0}, {0.5, 0.8, 9.0}};
  const QuantityError error = reference.error(Quantity::organ, run, 0.95, 8);
  EXPECT_NEAR(error.true_error, std::sqrt((9.0 + 16.0) / 2.0) / 100.0, 1e-12);
  EXPECT_NEAR(error.largest, 0.04, 1e-12);
  EXPECT_NEAR(error.reported, std::sqrt((25.0 + 4.0) / 2.0) / 100.0, 1e-12);
  EXPECT_EQ(error.covered, 0.5);
}

TEST(TradeoffError, ValuesWithoutIntervalsAreNeitherReportedNorCovered) {
  const TradeoffReference reference = organ_reference(0.0);
  const QuantityError some = reference.error(Quantity::organ, {{10.3, 38.4, 5.0}, {0.5, no_value, no_value}}, 0.95, 8);
  EXPECT_NEAR(some.reported, 0.05, 1e-12);
  EXPECT_EQ(some.covered, 1.0);
  const QuantityError no = reference.error(Quantity::organ, {{10.3, 38.4, 5.0}, {no_value, no_value, no_value}}, 0.95, 8);
  EXPECT_GT(no.true_error, 0.0);
  EXPECT_TRUE(std::isnan(no.reported));
  EXPECT_TRUE(std::isnan(no.covered));
}

TEST(TradeoffError, TheReferencesOwnErrorIsKnownAndWidensIntervals) {
  // With two parts at 9 and 11 the mean's standard error is 1, a tenth of the value; that of the other organ is 0.
  const TradeoffReference reference = organ_reference(1.0);
  EXPECT_NEAR(reference.own_error(Quantity::organ), 0.1 / std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(reference.own_error(Quantity::canopy)));
  // Student's t for 8 replicates at 95 % is 2.365: a value 2.3 away is covered though the half-width is nearly 0, one 2.4 away
  // is not.
  EXPECT_EQ(reference.error(Quantity::organ, {{12.3, 40.0, 0.0}, {1e-6, 0.1, no_value}}, 0.95, 8).covered, 1.0);
  EXPECT_EQ(reference.error(Quantity::organ, {{12.4, 40.0, 0.0}, {1e-6, 0.1, no_value}}, 0.95, 8).covered, 0.5);
}

// Returns runs that find such a value for the first organ, and for the others what the reference finds.
TradeoffReference runs_about(const TradeoffReference& reference, double value, double off) {
  TradeoffReference runs;
  for (const double sign : {-2.0, -1.0, 1.0, 2.0}) {
    RunValues run = reference.values();
    run[number(Quantity::organ)].value[0] = value + sign * off;
    runs.add(run);
  }
  return runs;
}

TEST(TradeoffError, RunsThatAgreeShowThatTheReferenceIsWrong) {
  const TradeoffReference reference = organ_reference(0.0);
  EXPECT_TRUE(reference.resolves(runs_about(reference, 10.01, 0.01), Quantity::organ));
  EXPECT_FALSE(reference.resolves(runs_about(reference, 12.0, 0.01), Quantity::organ));
}

TEST(TradeoffError, RunsThatScatterLessThanTheReferenceMayBeOffAreNotJudged) {
  const TradeoffReference reference = organ_reference(1.0);
  EXPECT_TRUE(reference.resolves(runs_about(reference, 10.0, 1.0), Quantity::organ));
  EXPECT_FALSE(reference.resolves(runs_about(reference, 10.0, 0.5), Quantity::organ));
}

TEST(TradeoffError, OtherNumbersOfValuesHaveNone) {
  EXPECT_TRUE(std::isnan(organ_reference(0.0).error(Quantity::organ, {{1.0}, {1.0}}, 0.95, 8).true_error));
}

TEST(TradeoffError, TypicalErrorLeavesTheReferencesOut) {
  // The squares are 9 and 41, with mean 25; without 9 it is 16.
  EXPECT_NEAR(typical_error({3.0, std::sqrt(41.0)}, 3.0), 4.0, 1e-12);
  EXPECT_NEAR(typical_error({3.0, 4.0}, no_value), std::sqrt(12.5), 1e-12);
  EXPECT_TRUE(std::isnan(typical_error({3.0, 4.0}, 3.0))) << "most of it would be the reference's";
  EXPECT_TRUE(std::isnan(typical_error({}, 0.0)));
  EXPECT_TRUE(std::isnan(typical_error({no_value}, 0.0)));
}

TEST(TradeoffFit, PowerLawGoesThroughItsPoints) {
  const std::vector<WorkAndError> points{{1.0, 8.0}, {16.0, 1.0}, {256.0, 0.125}, {4.0, no_value}, {0.0, 1.0}};
  const auto law = fit_power_law(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, -0.75, 1e-12);
  EXPECT_NEAR(law->factor, 8.0, 1e-12);
  EXPECT_NEAR(law->standard_error, 0.0, 1e-7);
}

TEST(TradeoffFit, StandardErrorIsThatOfLeastSquares) {
  // Logarithms x = 0, 1, 2 and y = 0, 0, 3 give slope 1.5, residuals 0.5, -1, 0.5, variance 1.5 / 1, and variance 1.5 / 2 of
  // the slope.
  const double e = std::exp(1.0);
  const auto law = fit_power_law(std::vector<WorkAndError>{{1.0, 1.0}, {e, 1.0}, {e * e, e * e * e}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1.5, 1e-12);
  EXPECT_NEAR(law->standard_error, std::sqrt(0.75), 1e-12);
  // Student's t at 97.5 % with one degree of freedom is 12.7062.
  EXPECT_NEAR(law->half_width(0.95), 12.7062 * std::sqrt(0.75), 1e-4);
}

TEST(TradeoffFit, NeedsTwoPoints) {
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_FALSE(fit_power_law(std::vector<WorkAndError>{{1.0, 1.0}}));
  EXPECT_FALSE(fit_power_law(std::vector<WorkAndError>{{2.0, 1.0}, {2.0, 3.0}}));
}

// Returns a level of the series of bounds whose runs have these organ errors.
TradeoffLevel bound_level(double bound, double seconds, const std::vector<double>& errors) {
  TradeoffLevel level{TradeoffSeries::bounds, bound, {}};
  for (const double error : errors) {
    TradeoffRun run{1, seconds, 1000, {}};
    run.errors[number(Quantity::organ)].true_error = error;
    level.runs.push_back(run);
  }
  level.error[number(Quantity::organ)] = typical_error(errors, no_value);
  return level;
}

TEST(Recommendation, InterpolatesBetweenRungs) {
  // The error equals the bound, the seconds are 1e-4 / bound^2, without spread.
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 0.0625, {0.04, 0.04}), bound_level(0.02, 0.25, {0.02, 0.02}),
                                          bound_level(0.01, 1.0, {0.01, 0.01})};
  const auto found = recommend(levels, 0.015, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->bound, 0.015, 1e-12);
  EXPECT_NEAR(found->seconds, 1e-4 / (0.015 * 0.015), 1e-9);
  EXPECT_NEAR(found->expected, 0.015, 1e-9);
  EXPECT_NEAR(found->margin, 1.0, 1e-12);
  EXPECT_FALSE(found->extrapolated);
}

TEST(Recommendation, KeepsAMarginForTheWorstSeed) {
  // The root mean square is 0.05 and the worst run 1.4 times that, so this level itself meets an error of 0.07.
  const std::vector<TradeoffLevel> levels{bound_level(0.2, 0.25, {0.02, 0.14}), bound_level(0.1, 1.0, {0.01, 0.07})};
  const auto found = recommend(levels, 0.0701, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->margin, 1.4, 1e-12);
  EXPECT_NEAR(found->bound, 0.1, 1e-12);
}

TEST(Recommendation, IsRoundedToTheSafeSide) {
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 1.0, {0.04}), bound_level(0.01, 16.0, {0.01})};
  const auto found = recommend(levels, 0.01299, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->bound, 0.012, 1e-12);
}

TEST(Recommendation, GoesBeyondTheFinestRungAndSaysSo) {
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 1.0, {0.04}), bound_level(0.02, 4.0, {0.02})};
  const auto found = recommend(levels, 0.01, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->extrapolated);
  EXPECT_NEAR(found->bound, 0.01, 1e-12);
  EXPECT_NEAR(found->seconds, 16.0, 1e-9);
  // Even where the error hardly falls with the bound, the bound is extrapolated as the square of the error, no faster.
  const std::vector<TradeoffLevel> flat{bound_level(0.04, 1.0, {0.021}), bound_level(0.02, 4.0, {0.02})};
  EXPECT_NEAR(recommend(flat, 0.01, Quantity::organ)->bound, 0.005, 1e-12);
}

TEST(Recommendation, OfASingleRungIsNotExtrapolated) {
  const std::vector<TradeoffLevel> level{bound_level(0.02, 4.0, {0.02})};
  const auto found = recommend(level, 0.03, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->bound, 0.02, 1e-12);
  EXPECT_NEAR(found->seconds, 4.0, 1e-9);
  EXPECT_FALSE(recommend(level, 0.015, Quantity::organ));
}

TEST(Recommendation, GoesNoFurtherThanATenthOfTheFinestRung) {
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 1.0, {0.04}), bound_level(0.02, 4.0, {0.02})};
  const auto found = recommend(levels, 0.00201, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->bound, 0.002, 1e-12);
  EXPECT_FALSE(recommend(levels, 0.00199, Quantity::organ));
  EXPECT_FALSE(recommend(levels, 1e-9, Quantity::organ));
}

TEST(Recommendation, StaysAtTheWidestBoundWhereThatIsEnough) {
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 1.0, {0.004}), bound_level(0.02, 4.0, {0.002})};
  const auto found = recommend(levels, 0.01, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->bound, 0.04, 1e-12);
  EXPECT_NEAR(found->seconds, 1.0, 1e-9);
}

TEST(Recommendation, AFinerRungThatErrsMoreCountsForTheWiderToo) {
  const std::vector<TradeoffLevel> levels{bound_level(0.04, 1.0, {0.01}), bound_level(0.02, 4.0, {0.02}),
                                          bound_level(0.01, 16.0, {0.01})};
  const auto found = recommend(levels, 0.0101, Quantity::organ);
  ASSERT_TRUE(found);
  EXPECT_LT(found->bound, 0.011);
}

TEST(Recommendation, NeedsErrorsOfBounds) {
  TradeoffLevel grid = bound_level(0.04, 1.0, {0.01});
  grid.series = TradeoffSeries::grids;
  EXPECT_FALSE(recommend({}, 0.01, Quantity::organ));
  EXPECT_FALSE(recommend({grid}, 0.01, Quantity::organ));
  EXPECT_FALSE(recommend({bound_level(0.04, 1.0, {0.0})}, 0.01, Quantity::organ));
  TradeoffLevel untold = bound_level(0.04, 1.0, {0.01});
  untold.error[number(Quantity::organ)] = no_value;
  EXPECT_FALSE(recommend({untold}, 0.01, Quantity::organ)) << "the reference is too coarse";
}

TEST(Recommendation, ReadsAsALine) {
  Recommendation found;
  found.bound = 0.004;
  found.seconds = 9.4;
  EXPECT_EQ(recommendation_line(found), "for 1 % per organ: --error 0.004, about 9.4 s on this device");
  found.extrapolated = true;
  found.seconds = 600.0;
  EXPECT_EQ(recommendation_line(found),
            "for 1 % per organ: --error 0.004, about 10 min on this device (beyond the bounds measured)");
}

TEST(TradeoffPlan, HalvesARoundSpacing) {
  RadiationModel model;
  model.plot = {1.8, 2.4, true};
  model.sun = SunPosition{1.0, 0.0};
  model.bands = {{"PAR", 350.0}};
  const TradeoffPlan plan = plan_tradeoff(model, 2e6, {});
  ASSERT_EQ(plan.grids_m.size(), 6U);
  EXPECT_NEAR(plan.grids_m.front(), 0.048, 1e-12);
  EXPECT_NEAR(plan.grids_m.back(), 0.0015, 1e-12);
  EXPECT_NEAR(4.32 / (plan.reference_grid_m * plan.reference_grid_m) * reference_parts, 4.0 * 4.32 / (0.0015 * 0.0015), 1.0);
  EXPECT_TRUE(plan.packets.empty()) << "nothing scatters";
  EXPECT_EQ(plan_tradeoff(model, 2e6, 0.0015).grids_m.size(), 6U);
  const TradeoffPlan own = plan_tradeoff(model, 2e6, 0.01);
  ASSERT_EQ(own.grids_m.size(), 7U);
  EXPECT_EQ(own.grids_m[3], 0.01);
}

}  // namespace
}  // namespace sunfleck

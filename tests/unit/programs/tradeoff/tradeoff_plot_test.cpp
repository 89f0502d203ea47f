#include "base/units.h"
#include "files/results/tables/tradeoff_table.h"
#include "programs/tradeoff/tradeoff_fit.h"
#include "support/gnuplot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sunfleck {
namespace {

constexpr test::Picture::Pixel blue{0x00, 0x72, 0xB2}, vermilion{0xD5, 0x5E, 0x00}, green{0x00, 0x9E, 0x73},
    purple{0xCC, 0x79, 0xA7}, black{0, 0, 0};

// Draws the table of a report with the variables that `tradeoff` sets.
class TradeoffPlot : public test::GnuplotTest {
 protected:
  [[nodiscard]] test::Picture picture(const TradeoffReport& report) const {
    PlotVariables variables;
    variables.set_file("table", folder_.write("tradeoff.csv", tradeoff_csv(report)));
    if (report.marked_grid_m) variables.set("grid", *report.marked_grid_m);
    if (report.recommendation) {
      variables.set("asked", report.recommendation->requested_error);
      variables.set("seconds", report.recommendation->seconds);
      variables.set("expected", report.recommendation->expected);
    }
    return draw("tradeoff.gp", variables);
  }
};

// Returns a setting with two runs that have these errors, by quantity.
TradeoffLevel level(TradeoffSeries series, double value, double seconds, std::uint64_t rays, std::array<double, 4> errors) {
  TradeoffLevel made{series, value, {}, errors};
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TradeoffRun run{seed, seconds, rays, {}};
    for (std::size_t q = 0; q < errors.size(); ++q) run.errors[q] = {errors[q], 2.0 * errors[q], 2.0 * errors[q], 1.0};
    made.runs.push_back(run);
  }
  return made;
}

// Returns figures like those of a maize plot.
TradeoffReport maize_report() {
  TradeoffReport report;
  report.record.title = "Maize, sparse planting, 60 x 60 cm, 2002-08-08 10:10";
  report.seeds = 2;
  for (int k = 0; k < 6; ++k) {
    const double more = std::pow(4.0, k);
    const double falls = std::pow(more, -0.68);
    report.levels.push_back(level(TradeoffSeries::grids, 0.024 * std::pow(0.5, k), 0.03 + 0.005 * more,
                                  static_cast<std::uint64_t>(7500 * more),
                                  {0.015 * falls, 0.051 * falls, 0.19 * falls, 5.5 * falls}));
  }
  for (int k = 0; k < 5; ++k) {
    const double more = std::pow(4.0, k);
    const double falls = 1.0 / std::sqrt(more);
    report.levels.push_back(level(TradeoffSeries::packets, 512.0 * more, 0.1 + 0.02 * more,
                                  static_cast<std::uint64_t>(4096 * more),
                                  {0.03 * falls, 0.035 * falls, 0.4 * falls, 10.0 * falls}));
  }
  for (int k = 0; k < 3; ++k) {
    const double more = std::pow(4.0, k);
    const double falls = std::pow(more, -0.4);
    report.levels.push_back(level(TradeoffSeries::bounds, 0.02 * std::pow(0.5, k), 0.9 * more,
                                  static_cast<std::uint64_t>(300000 * more),
                                  {0.0025 * falls, 0.01 * falls, 0.036 * falls, 1.4 * falls}));
  }
  report.fits = fit_series(report.levels);
  report.recommendation = Recommendation{0.01, Quantity::organ, 0.0024, 20.0, 0.009, 1.1, true};
  report.marked_grid_m = 0.0015;
  return report;
}

TEST_F(TradeoffPlot, HasACurveForEachQuantity) {
  const test::Picture drawn = picture(maize_report());
  EXPECT_EQ(drawn.width, 1600);
  EXPECT_EQ(drawn.height, 900);
  for (const test::Picture::Pixel& colour : {blue, vermilion, green, purple}) EXPECT_GT(drawn.count(colour), 1000U);
}

TEST_F(TradeoffPlot, MarksTheRecommendationAndTheGrid) {
  TradeoffReport report = maize_report();
  const std::size_t both = picture(report).count(black, 0x60);
  report.marked_grid_m.reset();
  const std::size_t recommendation = picture(report).count(black, 0x60);
  report.recommendation.reset();
  const std::size_t neither = picture(report).count(black, 0x60);
  EXPECT_GT(both, recommendation + 500) << "a dashed line and its name";
  EXPECT_GT(recommendation, neither + 500);
}

TEST_F(TradeoffPlot, ShowsTheLawsThatTheProgramFitted) {
  const TradeoffReport report = maize_report();
  const std::string table = folder_.write("tradeoff.csv", tradeoff_csv(report)).string();
  const std::string printed = folder_.write("laws", "").string();
  std::string script = "table = '" + table + "'\nload '" + SUNFLECK_SOURCE_DIR "/share/plots/tradeoff.gp'\n";
  script += "set print '" + printed + "'\n";
  for (std::size_t i = 1; i <= 8; ++i)
    script += fmt::format("print sprintf('%.3g %.3f %.2g', factor[{0}], slope[{0}], half_width[{0}])\n", i);
  EXPECT_EQ(draw_plot(script, folder_ / "a.png").value_or(""), "");
  ASSERT_EQ(report.fits.size(), 8U);
  std::string expected;
  for (const auto& [series, quantity, law, of_seconds] : report.fits)
    expected += fmt::format("{:.3g} {:.3f} {:.2g}\n", 100.0 * law.factor, law.exponent, law.half_width(0.95));
  EXPECT_EQ(test::content(printed), expected);
}

TEST_F(TradeoffPlot, WithoutLawsHasPointsAlone) {
  TradeoffReport report = maize_report();
  const std::size_t with_laws = picture(report).count(vermilion);
  report.fits.clear();
  const std::size_t without = picture(report).count(vermilion);
  EXPECT_GT(without, 1000U);
  EXPECT_GT(with_laws, without + 500U);
}

TEST_F(TradeoffPlot, WholeRunsAndCoarserMeshesAreDrawnToo) {
  TradeoffReport report = maize_report();
  const std::size_t all = picture(report).count(green);
  report.levels.push_back(level(TradeoffSeries::meshes, 0.5, 5.0, 5000000, {0.001, 0.02, 0.05, no_value}));
  const std::size_t with_mesh = picture(report).count(green);
  EXPECT_GT(with_mesh, all);
  report.levels.resize(11);
  EXPECT_LT(picture(report).count(green), all);
}

// gnuplot 5.4 does not take 5e-05, which has no decimal point, for a number.
TEST_F(TradeoffPlot, SubtractsTheReferencesOwnErrorHoweverItIsWritten) {
  TradeoffReport report = maize_report();
  report.levels = {level(TradeoffSeries::grids, 1e-5, 1.0, 1000, {8e-5, 0.001, 0.01, 0.1}),
                   level(TradeoffSeries::grids, 2e-5, 2.0, 4000, {8e-5, 0.001, 0.01, 0.1})};
  report.reference_rays[0] = 1'000'000;
  report.reference_error[0] = {5e-5, 5e-5, 5e-5, 5e-5};
  const std::size_t below_half = picture(report).count(blue);
  report.reference_error[0] = {7e-5, 5e-5, 5e-5, 5e-5};
  EXPECT_GT(below_half, picture(report).count(blue) + 100) << "points whose error is mostly the reference's are left out";
}

TEST_F(TradeoffPlot, OfAnythingThatCanBeMeasured) {
  const TradeoffReport whole = maize_report();
  TradeoffReport report;
  report.record.title = "it's `touch x` \"@x\" {a}_b^2 \\ \xff";
  EXPECT_EQ(picture(report).width, 1600);
  report.levels.push_back(level(TradeoffSeries::bounds, 0.02, 1.0, 100, {no_value, no_value, no_value, no_value}));
  report.levels.push_back(level(TradeoffSeries::grids, 0.02, 0.0, 100, {0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(picture(report).width, 1600);
  report.levels = {whole.levels.front()};
  EXPECT_EQ(picture(report).width, 1600);
  report.recommendation = whole.recommendation;
  EXPECT_EQ(picture(report).width, 1600);
}

}  // namespace
}  // namespace sunfleck

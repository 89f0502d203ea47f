#include "io/tradeoff_plot.h"
#include "support/gnuplot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace sunfleck {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr test::Picture::Pixel blue{0x00, 0x72, 0xB2}, vermilion{0xD5, 0x5E, 0x00}, green{0x00, 0x9E, 0x73},
    purple{0xCC, 0x79, 0xA7};

using TradeoffPlot = test::GnuplotTest;

// Returns a setting with two runs that have these errors, by quantity.
TradeoffRung rung(Ladder ladder, double value, double seconds, std::uint64_t rays, std::array<double, 4> errors) {
  TradeoffRung made{ladder, value, {}, errors};
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
    report.rungs.push_back(rung(Ladder::grids, 0.024 * std::pow(0.5, k), 0.03 + 0.005 * more,
                                static_cast<std::uint64_t>(7500 * more),
                                {0.015 * falls, 0.051 * falls, 0.19 * falls, 5.5 * falls}));
  }
  for (int k = 0; k < 5; ++k) {
    const double more = std::pow(4.0, k);
    const double falls = 1.0 / std::sqrt(more);
    report.rungs.push_back(rung(Ladder::packets, 512.0 * more, 0.1 + 0.02 * more, static_cast<std::uint64_t>(4096 * more),
                                {0.03 * falls, 0.035 * falls, 0.4 * falls, 10.0 * falls}));
  }
  for (int k = 0; k < 3; ++k) {
    const double more = std::pow(4.0, k);
    const double falls = std::pow(more, -0.4);
    report.rungs.push_back(rung(Ladder::bounds, 0.02 * std::pow(0.5, k), 0.9 * more, static_cast<std::uint64_t>(300000 * more),
                                {0.0025 * falls, 0.01 * falls, 0.036 * falls, 1.4 * falls}));
  }
  for (const Ladder ladder : {Ladder::grids, Ladder::packets}) {
    for (const Quantity quantity : quantities) {
      const TradeoffRung& first = report.rungs[ladder == Ladder::grids ? 0 : 6];
      TradeoffFit fit{ladder, quantity, {ladder == Ladder::grids ? -0.68 : -0.5, 1.0, 0.01}, {}};
      fit.of_rays.factor = first.error[static_cast<std::size_t>(quantity)] / std::pow(mean_rays(first), fit.of_rays.exponent);
      report.fits.push_back(fit);
    }
  }
  report.recommendation = Recommendation{0.01, Quantity::organ, 0.0024, 20.0, 0.009, 1.1, true};
  report.marked_grid_m = 0.0015;
  return report;
}

TEST_F(TradeoffPlot, ACurveForEachQuantity) {
  const std::string script = tradeoff_plot(maize_report());
  const test::Picture picture = draw(script);
  EXPECT_EQ(picture.width, 1600);
  EXPECT_EQ(picture.height, 900);
  for (const test::Picture::Pixel& colour : {blue, vermilion, green, purple}) EXPECT_GT(picture.count(colour), 1000U);
  EXPECT_NE(script.find("'0.15 cm grid'"), std::string::npos);
  EXPECT_NE(script.find("'\u22120.68'"), std::string::npos);
  EXPECT_NE(script.find("'--error 0.0024, about 20 s'"), std::string::npos);
}

TEST_F(TradeoffPlot, WholeRunsAndCoarserMeshesAreDrawnToo) {
  TradeoffReport report = maize_report();
  const std::size_t all = draw(tradeoff_plot(report)).count(green);
  report.rungs.push_back(rung(Ladder::meshes, 0.5, 5.0, 5000000, {0.001, 0.02, 0.05, none}));
  const std::size_t with_mesh = draw(tradeoff_plot(report)).count(green);
  EXPECT_GT(with_mesh, all);
  report.rungs.resize(11);
  EXPECT_LT(draw(tradeoff_plot(report)).count(green), all);
}

TEST_F(TradeoffPlot, OfAnythingThatCanBeMeasured) {
  const TradeoffReport whole = maize_report();
  TradeoffReport report;
  report.record.title = "it's `touch x` \"@x\" {a}_b^2 \\ \xff";
  EXPECT_EQ(draw(tradeoff_plot(report)).width, 1600);
  report.rungs.push_back(rung(Ladder::bounds, 0.02, 1.0, 100, {none, none, none, none}));
  report.rungs.push_back(rung(Ladder::grids, 0.02, 0.0, 100, {0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(draw(tradeoff_plot(report)).width, 1600);
  report.rungs = {whole.rungs.front()};
  EXPECT_EQ(draw(tradeoff_plot(report)).width, 1600);
  report.recommendation = whole.recommendation;
  EXPECT_EQ(draw(tradeoff_plot(report)).width, 1600);
}

}  // namespace
}  // namespace sunfleck

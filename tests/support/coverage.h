#pragma once
// Tests whether the reported errors of scattered light are true: runs seeds 1 to 400 of a small scene, each to its bounds like
// a user's run (G2 of the validation table).

#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

namespace sunfleck::test {

inline constexpr int coverage_seeds = 400;
// Bounds that a binomial count with probability 0.95 misses once in a thousand times.
inline constexpr int least_covered = 366;
inline constexpr int most_covered = 394;

// A figure, and how often the intervals of runs hold its true value.
class CoveredFigure {
 public:
  CoveredFigure(std::string what, const Estimate& truth) : what_(std::move(what)), truth_(truth) {}

  // Adds what a run found. Its half-width includes `unshot`.
  void add(const Estimate& got, double unshot) {
    const double off = std::abs(got.value - truth_.value);
    times_ += off <= got.half_width ? 1 : 0;
    by_sampling_ += off <= got.half_width - unshot ? 1 : 0;
    deviation_.add(got.value - truth_.value);
    half_width_.add(got.half_width);
  }

  // Expects the intervals to hold the true value as often as requested. Where the unshot flux is not small compared with the
  // sampling error, they may hold it more often, up to `most_with_unshot` times.
  void expect_covered(int most_with_unshot = most_covered) const {
    std::printf(
        "%-22s covered %d of %d times, %d by sampling; half-width %.1e on average, mean deviation %+.1e(%.0e), truth "
        "%.5f(%.0e)\n",
        what_.c_str(), times_, coverage_seeds, by_sampling_, half_width_.mean(), deviation_.mean(), deviation_.standard_error(),
        truth_.value, truth_.half_width);
    EXPECT_LE(truth_.half_width, 0.05 * half_width_.mean()) << what_;
    EXPECT_GE(times_, least_covered) << what_;
    EXPECT_LE(times_, most_with_unshot) << what_;
    EXPECT_LE(by_sampling_, most_covered) << what_;
  }

 private:
  std::string what_;
  Estimate truth_;
  int times_ = 0;
  int by_sampling_ = 0;  // by the half-width without its share for unshot flux
  ReplicateMean deviation_, half_width_;
};

// Returns the flux absorbed by leaves, absorbed by soil, and reflected, band by band.
inline std::vector<Estimate> fluxes_of(const RadiationResult& result) {
  std::vector<Estimate> fluxes;
  for (const BandResult& band : result.bands) {
    fluxes.insert(fluxes.end(), {band.absorbed_vegetation, band.absorbed_soil, band.reflected});
  }
  return fluxes;
}

// Returns fluxes of these bands as figures whose names begin with `of`.
inline std::vector<CoveredFigure> covered_fluxes(const std::vector<Estimate>& truths, const std::vector<BandResult>& bands,
                                                 const std::string& of = "") {
  const std::array names = {"leaves", "soil", "reflected"};
  std::vector<CoveredFigure> covered;
  for (const Estimate& flux : truths) {
    covered.emplace_back(of + bands[covered.size() / 3].name + ' ' + names[covered.size() % 3], flux);
  }
  return covered;
}

inline void add_fluxes(const RadiationResult& result, std::vector<CoveredFigure>& covered) {
  const std::vector<Estimate> got = fluxes_of(result);
  for (std::size_t k = 0; k < got.size(); ++k) covered[k].add(got[k], result.bands[k / 3].unshot);
}

// Expects the intervals of many short runs to cover the truth, which a long run of size `long_run` determines.
inline void expect_coverage(const RadiationModel& model, const ScatterWork& long_run, const Accuracy& accuracy,
                            int most_with_unshot = most_covered) {
  const Prepared prepared(model);
  const RadiationResult truth = simulate(model, prepared, fixed_scatter(model, long_run));
  std::vector<CoveredFigure> covered = covered_fluxes(fluxes_of(truth), truth.bands);
  SolveSettings settings;
  settings.accuracy = accuracy;
  ReplicateMean rounds, seconds, unshot;
  for (settings.seed = 1; settings.seed <= coverage_seeds; ++settings.seed) {
    const RadiationResult result = simulate(model, prepared, settings);
    rounds.add(static_cast<double>(result.indirect.rounds) / static_cast<double>(result.direct.replicates));
    seconds.add(result.direct.seconds + result.indirect.seconds);
    unshot.add(result.bands[0].unshot);
    add_fluxes(result, covered);
  }
  for (const CoveredFigure& figure : covered) figure.expect_covered(most_with_unshot);
  std::printf("%.1f rounds a replicate, %.0f ms a run, unshot PAR %.1e\n", rounds.mean(), 1e3 * seconds.mean(), unshot.mean());
}

}  // namespace sunfleck::test

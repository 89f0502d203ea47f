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

struct Covered {
  std::string what;
  double truth;
  int times = 0;
  int by_sampling = 0;  // covered by the half-width without its share for unshot flux
};

// Returns the flux absorbed by leaves, absorbed by soil, and reflected, band by band.
inline std::vector<Estimate> fluxes_of(const RadiationResult& result) {
  std::vector<Estimate> fluxes;
  for (const BandResult& band : result.bands) {
    fluxes.insert(fluxes.end(), {band.absorbed_vegetation, band.absorbed_soil, band.reflected});
  }
  return fluxes;
}

// Expects the intervals of many short runs to cover the truth, which a long run of size `long_run` determines. Half-widths
// include the unshot flux, so where that is not small compared with the sampling error they cover more often than requested: up
// to `most_with_unshot` times.
inline void expect_coverage(const RadiationModel& model, const ScatterWork& long_run, const Accuracy& accuracy,
                            int most_with_unshot = most_covered) {
  const Prepared prepared(model);
  const RadiationResult truth = simulate(model, prepared, fixed_scatter(model, long_run));
  std::vector<Covered> covered;
  const std::array names = {"leaves", "soil", "reflected"};
  for (const Estimate& flux : fluxes_of(truth)) {
    covered.push_back({truth.bands[covered.size() / 3].name + ' ' + names[covered.size() % 3], flux.value});
  }
  SolveSettings settings;
  settings.accuracy = accuracy;
  ReplicateMean replicates, seconds, unshot;
  std::vector<ReplicateMean> deviation(covered.size()), half_width(covered.size());
  for (settings.seed = 1; settings.seed <= coverage_seeds; ++settings.seed) {
    const RadiationResult result = simulate(model, prepared, settings);
    replicates.add(static_cast<double>(result.indirect.rounds) / static_cast<double>(result.direct.replicates));
    seconds.add(result.direct.seconds + result.indirect.seconds);
    unshot.add(result.bands[0].unshot);
    const std::vector<Estimate> got = fluxes_of(result);
    for (std::size_t k = 0; k < got.size(); ++k) {
      const double off = std::abs(got[k].value - covered[k].truth);
      covered[k].times += off <= got[k].half_width ? 1 : 0;
      covered[k].by_sampling += off <= got[k].half_width - result.bands[k / 3].unshot ? 1 : 0;
      deviation[k].add(got[k].value - covered[k].truth);
      half_width[k].add(got[k].half_width);
    }
  }
  const std::vector<Estimate> truths = fluxes_of(truth);
  for (std::size_t k = 0; k < covered.size(); ++k) {
    std::printf(
        "%-14s covered %d of %d times, %d by sampling; half-width %.1e on average, mean deviation %+.1e(%.0e), truth "
        "%.5f(%.0e)\n",
        covered[k].what.c_str(), covered[k].times, coverage_seeds, covered[k].by_sampling, half_width[k].mean(),
        deviation[k].mean(), deviation[k].standard_error(), covered[k].truth, truths[k].half_width);
    EXPECT_LE(truths[k].half_width, 0.05 * half_width[k].mean()) << covered[k].what;
    EXPECT_GE(covered[k].times, least_covered) << covered[k].what;
    EXPECT_LE(covered[k].times, most_with_unshot) << covered[k].what;
    EXPECT_LE(covered[k].by_sampling, most_covered) << covered[k].what;
  }
  std::printf("%.1f rounds a replicate, %.0f ms a run, unshot PAR %.1e\n", replicates.mean(), 1e3 * seconds.mean(),
              unshot.mean());
}

}  // namespace sunfleck::test

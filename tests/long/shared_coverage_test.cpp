// Tests whether the errors of lights that share packets, and of their sum, are true.
#include "support/coverage.h"

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr std::array<const char*, 3> names = {"noon ", "low sun ", "overcast "};
constexpr double step_s = 600.0;

// Returns a model at noon, with a low sun, and under an overcast sky.
std::vector<RadiationModel> three_moments() {
  const RadiationModel model = paper_model(random_leaves(8, 0.08, {}, 0.6, 11), {}, beijing_sun());
  std::vector<RadiationModel> moments(names.size(), model);
  const std::array suns = {sun_at(64.0, 180.0), sun_at(12.0, 95.0), sun_at(50.0, 130.0)};
  const std::array<double, 3> direct_w_m2 = {420.0, 60.0, 0.0}, diffuse_w_m2 = {60.0, 30.0, 120.0};
  for (std::size_t k = 0; k < moments.size(); ++k) {
    moments[k].sun = suns[k];
    moments[k].sky = SkyModel{.kind = SkyKind::general};
    for (Waveband& band : moments[k].bands) {
      band.direct_w_m2 = direct_w_m2[k];
      band.diffuse_w_m2 = diffuse_w_m2[k];
    }
  }
  return moments;
}

// Returns the sum of the fluxes of all moments; those of independent runs if there are no errors of the sum.
std::vector<Estimate> sum_of(const std::vector<RadiationResult>& results, const JointErrors* errors) {
  std::vector<Estimate> sums(fluxes_of(results.front()).size(), {0.0, 0.0});
  for (const RadiationResult& result : results) {
    const std::vector<Estimate> fluxes = fluxes_of(result);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k].value += step_s * fluxes[k].value;
      sums[k].half_width = std::hypot(sums[k].half_width, step_s * fluxes[k].half_width);
    }
  }
  for (std::size_t b = 0; errors != nullptr && b < errors->bands.size(); ++b) {
    const JointErrors::Band& band = errors->bands[b];
    sums[3 * b].half_width = band.vegetation;
    sums[3 * b + 1].half_width = band.soil;
    sums[3 * b + 2].half_width = band.reflected;
  }
  return sums;
}

TEST(SharedCoverage, IntervalsOfFourHundredRunsHoldTheTruthOfEachLightAndOfTheirSum) {
  const std::vector<RadiationModel> moments = three_moments();
  const Prepared prepared(moments.front());
  std::vector<RadiationResult> truths;
  std::vector<std::vector<CoveredFigure>> covered;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const ScatterWork work{.rays = 1e7, .packets = 2e5, .replicates = 80, .seed = 1000001 + k, .bound = 1e-6};
    truths.push_back(simulate(moments[k], prepared, fixed_scatter(moments[k], work)));
    covered.push_back(covered_fluxes(fluxes_of(truths.back()), truths.back().bands, names[k]));
  }
  std::vector<CoveredFigure> of_sum = covered_fluxes(sum_of(truths, nullptr), truths.front().bands, "sum ");

  WantedSums sums{{LightSum()}, {}};
  for (std::size_t k = 0; k < moments.size(); ++k) sums.of_lights[0].push_back({k, step_s});
  SolveSettings settings;
  settings.accuracy = {.direct = 0.02, .indirect = 0.02};
  CpuTracer tracer(prepared.bvh, tracer_scene(moments.front()));
  for (settings.seed = 1; settings.seed <= coverage_seeds; ++settings.seed) {
    std::vector<RadiationResult> results(moments.size());
    const SharedOutcome outcome = solve_lights(
        moments, prepared.layout, tracer, settings, {}, nullptr, sums,
        [&](std::size_t light, RadiationResult result, const SharedOutcome&) { results[light] = std::move(result); });
    for (std::size_t k = 0; k < results.size(); ++k) add_fluxes(results[k], covered[k]);
    const std::vector<Estimate> got = sum_of(results, &outcome.sum_errors.at(0));
    for (std::size_t k = 0; k < got.size(); ++k) {
      double unshot = 0.0;
      for (const RadiationResult& result : results) unshot += step_s * result.bands[k / 3].unshot;
      of_sum[k].add({got[k].value, got[k].half_width + unshot}, unshot);
    }
  }
  for (const std::vector<CoveredFigure>& of_moment : covered) {
    for (const CoveredFigure& figure : of_moment) figure.expect_covered(coverage_seeds);
  }
  for (const CoveredFigure& figure : of_sum) figure.expect_covered(coverage_seeds);
}

}  // namespace
}  // namespace sunfleck::test

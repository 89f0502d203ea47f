// Tests that few packets give a noisy answer, not a wrong one: ten thousand replicates of 64 and of 1024 packets, with few
// layers and with many.
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

constexpr int bias_replicates = 10'000;

std::vector<Estimate> fluxes_less_unshot(const RadiationResult& result) {
  std::vector<Estimate> fluxes;
  for (const BandResult& band : result.bands) {
    for (Estimate flux : {band.absorbed_vegetation, band.absorbed_soil, band.reflected}) {
      flux.half_width -= band.unshot;
      fluxes.push_back(flux);
    }
  }
  return fluxes;
}

void expect_no_bias(double packets) {
  RadiationModel model = paper_model(random_leaves(8, 0.08, {}, 0.6, 11), {}, beijing_sun());
  const ScatterWork many{.rays = 4e7, .packets = 2e5, .replicates = 200, .seed = 1, .bound = 1e-5};
  static const std::vector<Estimate> truth = fluxes_less_unshot(simulate(model, fixed_scatter(model, many)));
  const std::array names = {"PAR leaves", "PAR soil", "PAR reflected", "NIR leaves", "NIR soil", "NIR reflected"};
  for (const int layers : {1, 20, 100}) {
    model.layers = layers;
    const ScatterWork few{
        .rays = 1024.0 * bias_replicates, .packets = packets, .replicates = bias_replicates, .seed = 2, .bound = 0.003};
    const std::vector<Estimate> got = fluxes_less_unshot(simulate(model, fixed_scatter(model, few)));
    for (std::size_t k = 0; k < got.size(); ++k) {
      const double error = std::hypot(standard_error(got[k], bias_replicates), standard_error(truth[k], 200));
      const double bias = got[k].value - truth[k].value;
      std::printf("%.0f packets, %d layers, %-14s got %.6f off by %+.1e, error %.1e, z %+.1f\n", packets, layers, names[k],
                  got[k].value, bias, error, bias / error);
      EXPECT_LE(std::abs(bias), table_quantile(36, bias_replicates) * error) << packets << ' ' << layers << ' ' << names[k];
    }
  }
}

TEST(ScatterBias, SixtyFourPackets) {
  expect_no_bias(64);
}

TEST(ScatterBias, ThousandPackets) {
  expect_no_bias(1024);
}

}  // namespace
}  // namespace sunfleck::test

// Compares a whole maize stand with an independent Monte Carlo program: leaves, stems and soil are black, the plot is periodic,
// 3 x 3 m.
#include "support/comparison.h"
#include "support/field_stand.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <array>

namespace sunfleck::test {
namespace {

struct StandCase {
  SunPosition sun;
  std::array<Reference, 3> shares;  // leaf, stem, soil
  double tolerance;
};

void expect_shares(const StandCase& stand) {
  const RadiationModel model = black_model(stand_by_kind(), {3.0, 3.0, true}, stand.sun);
  ASSERT_EQ(model.canopy.size(), 97400U);
  const RadiationResult result = simulate(model, fixed_work(model, 4e6, usual_replicates));
  EXPECT_NEAR(result.leaf_area_index, 1.666, 5e-4);
  EXPECT_EQ(result.lost_rays, 0U);
  EXPECT_EQ(result.bands[0].ledger.residual(), 0);
  const std::array names{"leaf", "stem", "soil"};
  for (std::size_t organ = 0; organ < 3; ++organ) {
    const Reference& reference = stand.shares[organ];
    Estimate got = share_of_beam(model, result, organ);
    EXPECT_NEAR(got.value, reference.value, stand.tolerance) << names[organ];
    got.half_width = std::hypot(got.half_width, t_quantile(0.95, usual_replicates) * reference.error);
    expect_agrees(got, reference.value, usual_replicates, stand.tolerance / 2.0, 6, names[organ]);
  }
  // The soil's triangles lie in y = 0 and take precedence over the soil plane.
  EXPECT_EQ(result.bands[0].absorbed_vegetation.value + result.bands[0].absorbed_soil.value, result.bands[0].incident.value);
  EXPECT_NEAR(result.bands[0].absorbed_soil.value, share_of_beam(model, result, 2).value, 1e-9);
}

TEST(Stand, SharesUnderTheDataSun) {
  expect_shares({sun_at(52.975, 120.70), {{{0.72083, 8e-5}, {0.03111, 3e-5}, {0.24806, 8e-5}}}, 3e-4});
}

TEST(Stand, SharesUnderTheZenithSun) {
  expect_shares({sun_at(90.0, 0.0), {{{0.51663, 2.3e-4}, {0.00003, 1e-5}, {0.48335, 2.3e-4}}}, 7e-4});
}

}  // namespace
}  // namespace sunfleck::test

// Traces more than 2^32 rays, each of them in full.
#include "physics/light/beam_grid.h"
#include "support/comparison.h"
#include "support/models.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

TEST(ManyRays, MoreThanTwoToTheThirtySecond) {
  MeshMaker maker;
  maker.triangle({0.0, 0.5, 0.0}, {0.0, 0.5, 0.75}, {0.75, 0.5, 0.0});
  const RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, true}, sun_at(60.0, 33.0));
  constexpr int replicates = 17;
  const RadiationResult result =
      simulate(model, fixed_work(model, replicates * static_cast<double>(max_grid_rays), replicates));
  EXPECT_EQ(result.direct.rays, replicates * max_grid_rays);
  EXPECT_GT(result.direct.rays, std::uint64_t{1} << 32U);
  EXPECT_EQ(result.lost_rays, 0U);
  EXPECT_EQ(result.bands[0].ledger.residual(), 0);
  std::uint64_t landed = result.elements[0].upper;
  for (const std::uint64_t cell : result.soil_cells) landed += cell;
  EXPECT_EQ(landed, result.direct.rays);
  // An edge may be displaced by half a step of the rays' 24 bits.
  const Estimate got = result.bands[0].absorbed_vegetation;
  EXPECT_NEAR(got.value, 0.28125, 0x1p-23 + table_quantile(1, replicates) * standard_error(got, replicates));
  EXPECT_LT(standard_error(got, replicates), 1e-7);
}

}  // namespace
}  // namespace sunfleck::test

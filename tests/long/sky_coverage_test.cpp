// Tests whether the reported errors of sky light are true.
#include "support/coverage.h"

namespace sunfleck::test {
namespace {

TEST(SkyCoverage, IntervalsOfFourHundredRunsHoldTheTruth) {
  RadiationModel model = paper_model(random_leaves(8, 0.08, {}, 0.6, 11), {}, beijing_sun());
  shine_from_sky(model, {.kind = SkyKind::general});
  expect_coverage(model, {.packets = 2e5, .replicates = 64, .seed = 1000001, .bound = 1e-6}, {.indirect = 0.02},
                  coverage_seeds);
}

}  // namespace
}  // namespace sunfleck::test

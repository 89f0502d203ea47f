// Tests whether the reported errors of scattered light are true.
#include "support/coverage.h"

namespace sunfleck::test {
namespace {

TEST(ScatterCoverage, IntervalsOfFourHundredRunsHoldTheTruth) {
  const RadiationModel model = paper_model(random_leaves(8, 0.08, {}, 0.6, 11), {}, beijing_sun());
  expect_coverage(model, {.rays = 1e7, .packets = 1e5, .replicates = 80, .seed = 1000001, .bound = 1e-6},
                  {.direct = 0.02, .indirect = 0.04});
}

}  // namespace
}  // namespace sunfleck::test

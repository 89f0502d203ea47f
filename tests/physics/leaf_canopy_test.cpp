// A homogeneous canopy of horizontal leaves that reflect and transmit: B8 of the validation table, at the leaf size of B11.
#include "support/disc_canopies.h"

namespace sunfleck::test {
namespace {

TEST(LeafCanopy, HorizontalLeavesInParAndNir) {
  const auto got = disc_canopy_fluxes({.radius_m = 0.1, .count = 382, .horizontal = true, .corners = 8}, 60, 1e5, 4096);
  expect_row(got[0], {0.07104, 0.06063, 0.87745}, "horizontal PAR");
  expect_row(got[1], {0.49005, 0.3157, 0.2574}, "horizontal NIR");
}

}  // namespace
}  // namespace sunfleck::test

// Tests a homogeneous canopy of horizontal leaves that reflect and transmit (B8 of the validation table, at the leaf size of
// B11), and leaves of all orientations under the sky.
#include "support/disc_canopies.h"

namespace sunfleck::test {
namespace {

TEST(LeafCanopy, HorizontalLeavesInParAndNir) {
  const auto got = disc_canopy_fluxes({.radius_m = 0.1, .count = 382, .horizontal = true, .corners = 8}, 60, 1e5, 4096);
  expect_row(got[0], {0.07104, 0.06063, 0.87745}, "horizontal PAR");
  expect_row(got[1], {0.49005, 0.3157, 0.2574}, "horizontal NIR");
}

// Tests the diffuse columns of B9 at leaf area index 0.5: uniform sky, leaves of all orientations, extrapolated to small
// leaves.
TEST(LeafCanopy, SphericalLeavesUnderAUniformSky) {
  const DiscCanopy large{.radius_m = 0.1, .count = 64, .horizontal = false, .corners = 8};
  const DiscCanopy half{.radius_m = 0.05, .count = 255, .horizontal = false, .corners = 8};
  const auto a = disc_canopy_fluxes(large, 60, 0.0, 8192, CanopyLight::uniform_sky);
  const auto b = disc_canopy_fluxes(half, 60, 0.0, 8192, CanopyLight::uniform_sky);
  expect_row(without_leaf_size(a[0], b[0]), {0.09488, 0.67163, 0.33424}, "spherical PAR, sky");
  expect_row(without_leaf_size(a[1], b[1]), {0.28637, 0.82226, 0.05582}, "spherical NIR, sky");
}

}  // namespace
}  // namespace sunfleck::test

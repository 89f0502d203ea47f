// Tests homogeneous canopies with the leaf sizes in B11 of the validation table; each takes minutes.
#include "support/disc_canopies.h"

namespace sunfleck::test {
namespace {

TEST(DiscCanopies, LargeSphericalLeaves) {
  const auto got = disc_canopy_fluxes({.radius_m = 0.1, .count = 382, .horizontal = false}, 80, 2e5, 8192);
  expect_row(got[0], {0.04801, 0.16803, 0.80914}, "spherical PAR, r 0.10");
  expect_row(got[1], {0.40232, 0.43235, 0.25180}, "spherical NIR, r 0.10");
}

TEST(DiscCanopies, SmallHorizontalLeaves) {
  const auto got = disc_canopy_fluxes({.radius_m = 0.02, .count = 9549, .horizontal = true, .corners = 6}, 16, 4e5, 16384);
  expect_row(got[0], {0.06592, 0.06125, 0.88203}, "horizontal PAR, r 0.02");
  expect_row(got[1], {0.48181, 0.3225, 0.2602}, "horizontal NIR, r 0.02");
}

TEST(DiscCanopies, SmallSphericalLeaves) {
  const auto got = disc_canopy_fluxes({.radius_m = 0.02, .count = 9549, .horizontal = false, .corners = 6}, 16, 4e5, 16384);
  expect_row(got[0], {0.04615, 0.16860, 0.81054}, "spherical PAR, r 0.02");
  expect_row(got[1], {0.39992, 0.43435, 0.25259}, "spherical NIR, r 0.02");
}

// Tests the diffuse columns of B9 at leaf area index 3, extrapolated to small leaves.
TEST(DiscCanopies, SphericalLeavesUnderAUniformSky) {
  const DiscCanopy large{.radius_m = 0.1, .count = 382, .horizontal = false, .corners = 8};
  const DiscCanopy half{.radius_m = 0.05, .count = 1528, .horizontal = false, .corners = 8};
  const auto a = disc_canopy_fluxes(large, 80, 0.0, 8192, CanopyLight::uniform_sky);
  const auto b = disc_canopy_fluxes(half, 80, 0.0, 8192, CanopyLight::uniform_sky);
  expect_row(without_leaf_size(a[0], b[0]), {0.04935, 0.12814, 0.84173}, "spherical PAR, sky");
}

}  // namespace
}  // namespace sunfleck::test

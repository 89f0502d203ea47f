// Compares a whole maize stand with an independent Monte Carlo program: leaves, stems and soil are black, the plot is periodic,
// 3 x 3 m.
#include "files/formats/mesh/mesh_reader.h"
#include "support/comparison.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <array>

namespace sunfleck::test {
namespace {

constexpr int replicates = 32;

// Makes the leaves, the stems and the soil one organ each, so that their shares come with an error.
Mesh stand_by_kind() {
  Mesh mesh = read_mesh(std::filesystem::path(SUNFLECK_SOURCE_DIR) / "tests/data/maize60x60_25plants.can.gz", {});
  std::vector<std::uint32_t> kind_of;
  for (const Organ& organ : mesh.organs) kind_of.push_back(is_leaf_name(organ.name) ? 0 : organ.name == "stem" ? 1 : 2);
  for (std::uint32_t& organ : mesh.organ_of) organ = kind_of[organ];
  mesh.organs = {{1, "leaf", 0}, {1, "stem", 0}, {0, "soil", 0}};
  return mesh;
}

struct Reference {
  double share;
  double error;  // error of the reference itself
};
struct StandCase {
  SunPosition sun;
  std::array<Reference, 3> shares;  // leaf, stem, soil
  double tolerance;
};

void expect_shares(const StandCase& stand) {
  const RadiationModel model = black_model(stand_by_kind(), {3.0, 3.0, true}, stand.sun);
  ASSERT_EQ(model.canopy.size(), 97400U);
  const RadiationResult result = simulate(model, fixed_work(model, 4e6, replicates));
  EXPECT_NEAR(result.leaf_area_index, 1.666, 5e-4);
  EXPECT_EQ(result.lost_rays, 0U);
  EXPECT_EQ(result.bands[0].ledger.residual(), 0);
  const std::array names{"leaf", "stem", "soil"};
  for (std::size_t organ = 0; organ < 3; ++organ) {
    const Reference& reference = stand.shares[organ];
    Estimate got = share_of_beam(model, result, organ);
    EXPECT_NEAR(got.value, reference.share, stand.tolerance) << names[organ];
    got.half_width = std::hypot(got.half_width, t_quantile(0.95, replicates) * reference.error);
    expect_agrees(got, reference.share, replicates, stand.tolerance / 2.0, 6, names[organ]);
  }
  // The soil's triangles lie in y = 0 and take precedence over the soil plane.
  EXPECT_EQ(result.bands[0].absorbed_vegetation.value + result.bands[0].absorbed_soil.value, result.bands[0].incident);
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

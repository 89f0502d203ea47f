// Tests scenes given leaf by leaf, whose light was also computed by independent programs: scene S1 of the validation table
// (B12) and a whole maize stand, in PAR and NIR.
#include "programs/validate/known/canopy_scenes.h"
#include "support/comparison.h"
#include "support/field_stand.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <array>

namespace sunfleck::test {
namespace {

TEST(ExplicitScene, IsTheOneOfTheTable) {
  const Mesh mesh = explicit_leaves();
  const auto middle_m = [&](std::size_t leaf) { return 0.5 * (mesh.vertices.at(6 * leaf) + mesh.vertices.at(6 * leaf + 2)); };
  EXPECT_LE(glm::length(middle_m(0) - from_east_north_up(0.120885, 0.347903, 0.669735)), 1e-6);
  EXPECT_LE(glm::length(middle_m(1) - from_east_north_up(0.376987, 0.680171, 0.494081)), 1e-6);
  const RadiationModel model = paper_model(mesh, {}, beijing_sun());
  double area = 0.0;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) area += area_m2(model.canopy.corners[e]);
  EXPECT_NEAR(area, 3.0, 1e-6);
  const glm::dvec3 normal = from_east_north_up(-0.322204, -0.385838, 0.864473);
  EXPECT_LE(glm::length(unit_normal(model.canopy.corners[0]) - normal), 1e-5);
}

TEST(ExplicitScene, TotalsAndLeavesUnderThePaperSun) {
  const RadiationModel model = paper_model(explicit_leaves(), {}, beijing_sun());
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1.6e7, .packets = 120000}));
  struct Totals {
    Reference reflected, leaves, on_soil;
    double in_soil;
  };
  const std::array totals = {Totals{{0.051649, 9e-6}, {0.788413, 4e-5}, {0.188160, 4e-5}, 0.159936},
                             Totals{{0.405730, 9e-5}, {0.241976, 3e-5}, {0.440377, 1.1e-4}, 0.352302}};
  for (std::size_t b = 0; b < 2; ++b) {
    const BandResult& band = result.bands[b];
    const double largest = b == 0 ? 1e-4 : 2e-4;
    expect_within(band.reflected, totals[b].reflected, usual_replicates, largest, band.name + " reflected");
    expect_within(band.absorbed_vegetation, totals[b].leaves, usual_replicates, largest, band.name + " absorbed by leaves");
    expect_within(result.layers[0].down[b], totals[b].on_soil, usual_replicates, largest, band.name + " on soil");
    const double soil_absorptance = 1.0 - model.soil->reflectance[b];
    expect_within(band.absorbed_soil, {totals[b].in_soil, soil_absorptance * totals[b].on_soil.error}, usual_replicates,
                  largest, band.name + " absorbed by soil");
  }
  expect_within(result.ground_sunfleck_ratio, {0.172756, 5e-5}, usual_replicates, 1e-4, "beam on soil");
  struct Leaf {
    Reference first_hit, par, nir;
  };
  const std::array leaves = {
      Leaf{{0.2916, 7e-4}, {0.27760, 6e-4}, {0.08815, 2e-4}}, Leaf{{0.00869, 1e-4}, {0.04246, 2e-4}, {0.05880, 2e-4}},
      Leaf{{0.0, 0.0}, {0.03478, 1e-4}, {0.05982, 2e-4}},     Leaf{{0.9038, 1.1e-3}, {0.77598, 9e-4}, {0.12936, 2e-4}},
      Leaf{{0.3790, 7e-4}, {0.35758, 6e-4}, {0.10046, 2e-4}}, Leaf{{0.2635, 7e-4}, {0.26396, 6e-4}, {0.09690, 2e-4}}};
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const OrganResult& organ = result.organs[leaf];
    const std::string name = "leaf " + std::to_string(leaf);
    expect_within(organ.direct[0], leaves[leaf].first_hit, usual_replicates, 1e-3, name + " first hit");
    expect_within(organ.absorbed[0], leaves[leaf].par, usual_replicates, 1e-3, name + " absorbed PAR");
    expect_within(organ.absorbed[1], leaves[leaf].nir, usual_replicates, 1e-3, name + " absorbed NIR");
  }
  for (const BandResult& band : result.bands) EXPECT_EQ(band.ledger.residual(), 0) << band.name;
  EXPECT_EQ(result.lost_rays, 0U);
}

// Assigns the optics 0, 1 and 2 to the leaves, stems and soil of the stand.
RadiationModel maize_stand() {
  const std::array bands = {LeafBand{"PAR", 0.12, 0.06, 0.15}, LeafBand{"NIR", 0.40, 0.45, 0.35}};
  RadiationModel model = leaf_model(stand_by_kind(), {3.0, 3.0, true}, sun_at(52.975, 120.70), bands);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    model.optics[1].upper[b] = model.optics[1].lower[b] = {bands[b].reflectance, 0.0};
    model.optics[2].upper[b] = model.optics[2].lower[b] = {bands[b].soil_reflectance, 0.0};
  }
  return model;
}

TEST(ExplicitScene, MaizeStandInParAndNir) {
  const RadiationModel model = maize_stand();
  ASSERT_EQ(model.canopy.size(), 97400U);
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 2e6, .packets = 32768}));
  struct Shares {
    Reference leaf, stem, soil, reflected;
    double tolerance;
  };
  const std::array expected = {Shares{{0.67631, 7e-5}, {0.03779, 3e-5}, {0.22927, 7e-5}, {0.05663, 1e-5}, 0.0005},
                               Shares{{0.23191, 7e-5}, {0.07617, 7e-5}, {0.33639, 1.4e-4}, {0.35553, 1.5e-4}, 0.001}};
  for (std::size_t b = 0; b < 2; ++b) {
    const Shares& band = expected[b];
    const std::string name = result.bands[b].name;
    const auto organ_share = [&](std::size_t organ) {
      return result.organs[organ].absorbed[b].scaled(result.organs[organ].area_m2 / model.plot.area_m2());
    };
    const std::array got = {organ_share(0), organ_share(1), result.bands[b].absorbed_soil, result.bands[b].reflected};
    const std::array references = {band.leaf, band.stem, band.soil, band.reflected};
    const std::array names = {"leaf", "stem", "soil", "reflected"};
    for (std::size_t k = 0; k < got.size(); ++k) {
      EXPECT_NEAR(got[k].value, references[k].value, band.tolerance) << name << ' ' << names[k];
      expect_within(got[k], references[k], usual_replicates, band.tolerance / 2.0, name + ' ' + names[k]);
    }
    EXPECT_EQ(result.bands[b].ledger.residual(), 0);
  }
  EXPECT_EQ(result.lost_rays, 0U);
}

}  // namespace
}  // namespace sunfleck::test

// Tests the balance of scenes with structures and lamps beside the vegetation.
#include "physics/transport/model/surfaces.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

// A panel above one half of a plot of 1 m2, and a leaf above all of it; numbers of organs and optics.
constexpr std::size_t panel = 0, leaf = 1;

RadiationModel panel_above_leaf(double elevation_deg) {
  MeshMaker mesh;
  mesh.organ("panel");
  mesh.level(0.0, 0.5, 0.0, 1.0, 1.0);
  mesh.organ("leaf");
  mesh.level(0.0, 1.0, 0.0, 1.0, 0.3);
  return black_model(mesh.mesh(), Plot{}, sun_at(elevation_deg, 120.0));
}

TEST(Structures, TakeTheirPartOfTheBeam) {
  for (const double elevation_deg : {90.0, 35.0}) {
    const RadiationModel model = panel_above_leaf(elevation_deg);
    const RadiationResult result = simulate(model, fixed_work(model, 1e5));
    const BandResult& band = result.bands[0];
    EXPECT_EQ(band.ledger.residual(), 0);
    EXPECT_NEAR(band.absorbed_structure.value, 0.5, 1e-3);
    EXPECT_EQ(band.ledger.absorbed_vegetation + band.ledger.absorbed_structure, band.ledger.incident);
    EXPECT_EQ(band.ledger.absorbed_soil, 0);
    EXPECT_EQ(result.leaf_area_index, 1.0);
    EXPECT_NEAR(result.sunlit_leaf_fraction.value, 0.5, 1e-3);
  }
}

// Sums over the layers and over the organs equal the terms of the balance, in the beam and in scattered light.
TEST(Structures, AbsorbWhatTheirOrgansAndLayersDo) {
  RadiationModel model = panel_above_leaf(40.0);
  set_faces(model, panel, {{0.5, 0.0}});
  set_faces(model, leaf, {{0.3, 0.3}});
  model.soil->reflectance = {0.4};
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 2e4));
  const BandResult& band = result.bands[0];
  Estimate in_layers{0.0, 0.0}, structures_in_layers{0.0, 0.0};
  for (std::size_t k = 0; k + 1 < result.layers.size(); ++k) {
    in_layers.value += result.layers[k].absorbed[0].value;
    structures_in_layers.value += result.layers[k].absorbed_structure[0].value;
  }
  EXPECT_NEAR(in_layers.value, band.absorbed_vegetation.value, 1e-6);
  EXPECT_NEAR(structures_in_layers.value, band.absorbed_structure.value, 1e-6);
  EXPECT_NEAR(result.organs[panel].absorbed[0].value * result.organs[panel].area_m2, band.absorbed_structure.value, 1e-6);
  EXPECT_NEAR(result.organs[leaf].absorbed[0].value * result.organs[leaf].area_m2, band.absorbed_vegetation.value, 1e-6);
  EXPECT_GT(band.absorbed_structure.value, 0.25);
  EXPECT_GT(band.absorbed_structure.half_width, 0.0);
  EXPECT_LT(band.absorbed_structure.half_width, 0.01);
}

TEST(Structures, AreAnExactZeroWhereThereAreNone) {
  RadiationModel model = panel_above_leaf(40.0);
  for (SurfaceOptics& optics : model.optics) optics.role = Role::leaf;
  set_faces(model, leaf, {{0.3, 0.3}});
  const RadiationResult result = simulate_soundly(model, fixed_packets(model, 1e3, 12));
  EXPECT_EQ(result.bands[0].absorbed_structure.value, 0.0);
  EXPECT_EQ(result.bands[0].absorbed_structure.half_width, 0.0);
  EXPECT_EQ(result.leaf_area_index, 1.5);
}

}  // namespace
}  // namespace sunfleck::test

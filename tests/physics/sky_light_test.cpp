// Tests light from the sky: the light that single faces receive, the light that canopies absorb (B12 and E of the validation
// table), and the identities that hold with it.
#include "programs/validate/known/canopy_scenes.h"
#include "support/comparison.h"
#include "support/field_stand.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <array>

namespace sunfleck::test {
namespace {

RadiationModel under_sky(RadiationModel model, const SkyModel& sky) {
  shine_from_sky(model, sky);
  return model;
}

SkyModel general_sky(int type) {
  return {.kind = SkyKind::general, .cie_type = type};
}

TEST(SkyLight, ExplicitSceneUnderUniformAndOvercastSkies) {
  struct Row {
    SkyKind kind;
    Reference reflected, leaves, on_soil, passed;
    double in_soil;
  };
  const std::array rows = {
      Row{SkyKind::uniform, {0.053482, 2e-5}, {0.837763, 5e-5}, {0.127951, 6e-5}, {0.113245, 6e-5}, 0.108758},
      Row{SkyKind::overcast, {0.052310, 1e-5}, {0.826358, 8e-5}, {0.142742, 9e-5}, {0.127740, 9e-5}, 0.121331}};
  for (const Row& row : rows) {
    RadiationModel model = under_sky(paper_model(explicit_leaves(), {}, beijing_sun()), {.kind = row.kind});
    model.sun.reset();
    const RadiationResult result = simulate(model, fixed_scatter(model, {.packets = 98304}));
    const BandResult& par = result.bands[0];
    expect_within(par.reflected, row.reflected, usual_replicates, 1e-4, "reflected");
    expect_within(par.absorbed_vegetation, row.leaves, usual_replicates, 2e-4, "absorbed by leaves");
    expect_within(result.layers[0].down[0], row.on_soil, usual_replicates, 2e-4, "on soil");
    expect_within(par.absorbed_soil, {row.in_soil, 0.85 * row.on_soil.error}, usual_replicates, 2e-4, "absorbed by soil");
    const double passed_error = 3.0 * std::hypot(row.passed.error, standard_error(result.layers[0].down[0], usual_replicates));
    EXPECT_NEAR(sky_on_soil_w_m2(model, result, 0), row.passed.value, passed_error);
    EXPECT_EQ(par.ledger.residual(), 0);
    EXPECT_NEAR(par.incident.value, 1.0, 1e-12);
    EXPECT_EQ(result.direct.rays, 0U);
  }
}

// A vertical black square above black soil, alone, receives half of each sky's vertical irradiance tables (E1 to E4).
struct VerticalCase {
  const char* what;
  SkyModel sky;
  std::array<double, 4> toward;  // vertical irradiance towards north, east, south, west, relative to the horizontal
};

TEST(SkyLight, VerticalSquareSeesTheTables) {
  const std::array cases = {VerticalCase{"uniform", {}, {0.5, 0.5, 0.5, 0.5}},
                            VerticalCase{"overcast", {.kind = SkyKind::overcast}, {0.396177, 0.396177, 0.396177, 0.396177}},
                            VerticalCase{"type 4", general_sky(4), {0.33892, 0.49337, 0.44326, 0.31672}},
                            VerticalCase{"type 12", general_sky(12), {0.39034, 0.78120, 0.64176, 0.35554}},
                            VerticalCase{"type 14", general_sky(14), {0.38965, 0.89532, 0.71540, 0.34382}},
                            VerticalCase{"Perez clear",
                                         {.kind = SkyKind::all_weather, .dni_w_m2 = 850.0, .dhi_w_m2 = 100.0},
                                         {0.43355, 0.80890, 0.66418, 0.41844}},
                            VerticalCase{"Perez overcast",
                                         {.kind = SkyKind::all_weather, .dni_w_m2 = 5.0, .dhi_w_m2 = 300.0},
                                         {0.39093, 0.47206, 0.44760, 0.37611}}};
  const std::array normals = {glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)};
  for (const VerticalCase& each : cases) {
    // One square faces north and south, the other east and west.
    for (const std::size_t pair : {0U, 1U}) {
      MeshMaker maker;
      maker.polygon({0.05, 0.08, 0.05}, normals[pair], 0.01, 4);
      const Plot plot{0.1, 0.1, false};
      RadiationModel model = under_sky(black_model(maker.mesh(), plot, beijing_sun()), each.sky);
      const RadiationResult result = simulate(model, fixed_scatter(model, {.packets = 65536}));
      EXPECT_EQ(result.bands[0].ledger.residual(), 0);
      double area = 0.0;
      std::array<double, 2> faces{};
      for (std::size_t e = 0; e < model.canopy.size(); ++e) {
        const double element_m2 = area_m2(model.canopy.corners[e]);
        area += element_m2;
        for (std::size_t side = 0; side < 2; ++side) {
          faces[side] += result.side_sky_w_m2(2 * e + side, element_m2, 0) * element_m2;
        }
      }
      // Only both faces together have an error of their own; the error of each face is at most about as large.
      const double error = standard_error(result.organs[0].indirect[0], usual_replicates);
      EXPECT_LE(error, 0.0015) << each.what;
      for (std::size_t side = 0; side < 2; ++side) {
        const double expected = each.toward[pair + 2 * side];
        std::printf("%-16s face %zu expected %.5f got %.5f(%.1e)\n", each.what, pair + 2 * side, expected, faces[side] / area,
                    error);
        EXPECT_NEAR(faces[side] / area, expected, 3.5 * error + 0.003 * expected) << each.what;
      }
    }
  }
}

// Compares the light that leaves, stems and soil of a whole stand absorb from the overcast sky with a reference of 46
// directions.
TEST(SkyLight, StandUnderTheOvercastSky) {
  const Mesh mesh = stand_by_kind();
  RadiationModel model = under_sky(black_model(mesh, {3.0, 3.0, true}, beijing_sun()), {.kind = SkyKind::overcast});
  model.sun.reset();
  const RadiationResult result = simulate(model, fixed_scatter(model, {.packets = 32768}));
  const std::array expected = {0.744, 0.029, 0.226};
  for (std::size_t organ = 0; organ < expected.size(); ++organ) {
    const Estimate share = result.organs[organ].indirect[0].scaled(result.organs[organ].area_m2 / 9.0);
    std::printf("%s: expected %.3f got %.5f(%.1e)\n", mesh.organs[organ].name.c_str(), expected[organ], share.value,
                standard_error(share, usual_replicates));
    EXPECT_LE(standard_error(share, usual_replicates), 4e-4);
    EXPECT_NEAR(share.value, expected[organ], 0.003);
  }
}

TEST(SkyLight, ALampListIsABeamFromEachDirection) {
  const Plot plot{1.0, 1.0, true};
  const Mesh leaves = random_leaves(40, 0.02, plot, 1.0, 3);
  RadiationModel beam = paper_model(leaves, plot, beijing_sun());
  SkyModel sky{.kind = SkyKind::lights};
  sky.lights = {{1.0, direction_to_sun(beijing_sun())}};
  RadiationModel listed = under_sky(beam, sky);
  listed.sun.reset();
  const RadiationResult by_beam = simulate(beam, fixed_scatter(beam, {.rays = 2e6, .packets = 16384}));
  const RadiationResult by_sky = simulate(listed, fixed_scatter(listed, {.packets = 32768}));
  for (std::size_t b = 0; b < 2; ++b) {
    expect_same(by_sky.bands[b].absorbed_vegetation, by_beam.bands[b].absorbed_vegetation, usual_replicates, 1e-3, 6, "leaves");
    expect_same(by_sky.bands[b].absorbed_soil, by_beam.bands[b].absorbed_soil, usual_replicates, 1e-3, 6, "soil");
    expect_same(by_sky.bands[b].reflected, by_beam.bands[b].reflected, usual_replicates, 1e-3, 6, "reflected");
  }
}

// B14 (iii): sun and sky together give the sum of what each gives alone.
TEST(SkyLight, SunAndSkyAddUp) {
  const Plot plot{1.0, 1.5, true};
  const RadiationModel sun = paper_model(random_leaves(60, 0.02, plot, 1.0, 7), plot, beijing_sun());
  const RadiationModel sky = under_sky(sun, general_sky(12));
  RadiationModel both = sun;
  both.sky = general_sky(12);
  for (Waveband& band : both.bands) {
    band.direct_w_m2 = 0.7;
    band.diffuse_w_m2 = 0.3;
  }
  const auto run = [](const RadiationModel& model, std::uint64_t seed) {
    return simulate(model, fixed_scatter(model, {.rays = 5e5, .packets = 16384, .seed = seed}));
  };
  const RadiationResult by_sun = run(sun, 1);
  const RadiationResult by_sky = run(sky, 2);
  const RadiationResult by_both = run(both, 3);
  for (std::size_t b = 0; b < 2; ++b) {
    const auto expect_sum = [&](Estimate BandResult::*part, const char* what) {
      const Estimate a = (by_sun.bands[b].*part).scaled(0.7);
      const Estimate c = (by_sky.bands[b].*part).scaled(0.3);
      const Estimate sum{a.value + c.value, std::hypot(a.half_width, c.half_width)};
      expect_same(by_both.bands[b].*part, sum, usual_replicates, 1e-3, 6, what);
    };
    expect_sum(&BandResult::absorbed_vegetation, "leaves");
    expect_sum(&BandResult::absorbed_soil, "soil");
    expect_sum(&BandResult::reflected, "reflected");
  }
}

// B14 (i) and (ix): the ledger closes in every kind of scene, and black surfaces reflect nothing.
TEST(SkyLight, LedgerClosesInIntegers) {
  const std::array bands = {par_band, nir_band, LeafBand{"white", 0.6, 0.4, 1.0}, LeafBand{"black", 0.0, 0.0, 0.0}};
  for (const bool periodic : {true, false}) {
    for (const bool has_soil : {true, false}) {
      for (const bool has_sun : {true, false}) {
        const Plot plot{1.0, 1.5, periodic};
        RadiationModel model = black_model(random_leaves(60, 0.02, plot, 1.0, 7), plot, beijing_sun());
        if (!has_soil) model.soil.reset();
        set_leaf_bands(model, bands);
        model.sky = SkyModel{.kind = SkyKind::overcast};
        for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.5;
        if (!has_sun) model = under_sky(model, *model.sky);
        const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e5, .packets = 2048, .replicates = 8}));
        EXPECT_EQ(result.lost_rays, 0U);
        for (std::size_t b = 0; b < bands.size(); ++b) {
          const BandResult& band = result.bands[b];
          EXPECT_EQ(band.ledger.residual(), 0) << band.name;
          EXPECT_GT(band.incident.value, 0.0);
          EXPECT_LE(band.unshot, 1e-5 * band.incident.value) << band.name;
          if (periodic) {
            EXPECT_NEAR(band.incident.value, has_sun ? 1.5 : 1.0, 1e-9);
          }
          const LayerResult& top = result.layers.back();
          EXPECT_NEAR(top.down[b].value, band.incident.value, 1e-9);
          EXPECT_NEAR(top.up[b].value, band.reflected.value, 1e-9);
        }
        EXPECT_EQ(result.bands[2].ledger.absorbed_vegetation, 0);
        EXPECT_EQ(result.bands[3].ledger.reflected, 0);
        EXPECT_EQ(result.bands[3].ledger.unshot, 0);
      }
    }
  }
}

// A canopy under a level roof without gaps receives no sky light.
TEST(SkyLight, NothingPassesAFullRoof) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.0, 1.0, 0.0, 1.0, 1.0);
  maker.organ("leaf", 1, 2);
  maker.level(0.2, 0.7, 0.1, 0.9, 0.5);
  const Plot plot{1.0, 1.0, true};
  RadiationModel model = under_sky(black_model(maker.mesh(), plot, beijing_sun()), general_sky(12));
  const RadiationResult result = simulate(model, fixed_scatter(model, {.packets = 4096, .replicates = 8}));
  EXPECT_NEAR(result.organs[0].indirect[0].value, 1.0, 1e-9);
  EXPECT_EQ(result.organs[1].indirect[0].value, 0.0);
  EXPECT_EQ(result.bands[0].absorbed_soil.value, 0.0);
}

}  // namespace
}  // namespace sunfleck::test

// Tests extreme light: none, faint and bright bands side by side, all of it scattered or all absorbed; and scattering scenes of
// a micrometre or of ten kilometres.
#include "extremes/tracers.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sunfleck::test {
namespace {

class ExtremeLight : public EveryTracer {};

Mesh leaves() {
  return random_leaves(60, 0.02, unit_plot, 1.0, 7);
}

// Sets bands that differ only in their light.
void set_lights(RadiationModel& model, std::span<const Waveband> lights, const FaceOptics& face, double soil) {
  model.bands.assign(lights.begin(), lights.end());
  for (SurfaceOptics& optics : model.optics) {
    optics.upper.assign(lights.size(), face);
    optics.lower = optics.upper;
  }
  model.soil->reflectance.assign(lights.size(), soil);
  model.sky = SkyModel{.kind = SkyKind::overcast};
}

// Returns a beam from 1e-12 to 1e12 W m-2 in twenty bands, and sky light from 1e12 down to 1e-12.
std::vector<Waveband> crossing_lights() {
  constexpr int count = 20;
  std::vector<Waveband> lights;
  for (int b = 0; b < count; ++b) {
    const double power = 24.0 * b / (count - 1) - 12.0;
    lights.push_back({fmt::format("band{}", b), std::pow(10.0, power), std::pow(10.0, -power)});
  }
  return lights;
}

// The ledger omits this share of a beam that is too faint for its integers: 2^-47 of the incident flux for each ray.
constexpr double left_out = 4e4 * 0x1p-47;

// With black surfaces all bands see the same rays: each band absorbs the beam's share of its beam and the sky's share of its
// sky light.
TEST_F(ExtremeLight, BeamAndSkyOfAnySizeInTwentyBands) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    RadiationModel model = black_model(leaves(), plot, beijing_sun());
    std::vector<Waveband> lights = crossing_lights();
    lights.push_back({"sun", 1.0, 0.0});
    lights.push_back({"sky", 0.0, 1.0});
    set_lights(model, lights, {}, 0.0);
    const RadiationResult result = run(model, fixed_scatter(model, {.rays = 8e4, .packets = 2000, .replicates = 8}));
    const BandResult& sun = result.bands[lights.size() - 2];
    const BandResult& sky = result.bands.back();
    EXPECT_NEAR(sun.incident.value, plot.periodic ? 1.0 : sun.incident.value, 1e-12);
    EXPECT_NEAR(sky.incident.value, plot.periodic ? 1.0 : sky.incident.value, 1e-12);
    for (std::size_t b = 0; b < lights.size(); ++b) {
      const BandResult& band = result.bands[b];
      const auto expected = [&](double of_sun, double of_sky) {
        return lights[b].direct_w_m2 * of_sun + lights[b].diffuse_w_m2 * of_sky;
      };
      const double incident = expected(sun.incident.value, sky.incident.value);
      const double tolerance = (1e-9 + left_out) * incident;
      EXPECT_GT(band.ledger.incident, 0);
      EXPECT_NEAR(band.incident.value, incident, tolerance) << band.name;
      EXPECT_NEAR(band.absorbed_vegetation.value, expected(sun.absorbed_vegetation.value, sky.absorbed_vegetation.value),
                  tolerance);
      EXPECT_NEAR(band.absorbed_soil.value, expected(sun.absorbed_soil.value, sky.absorbed_soil.value), tolerance);
    }
  }
}

// With leaves that scatter, too, the ledgers close and reported shares stay shares.
TEST_F(ExtremeLight, ScatteredLightOfAnySizeInTwentyBands) {
  RadiationModel model = black_model(leaves(), unit_plot, beijing_sun());
  const std::vector<Waveband> lights = crossing_lights();
  set_lights(model, lights, {0.45, 0.45}, 0.2);
  const RadiationResult result = run(model, fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8}));
  for (std::size_t b = 0; b < lights.size(); ++b) {
    const double incident = lights[b].direct_w_m2 + lights[b].diffuse_w_m2;
    const BandResult& band = result.bands[b];
    EXPECT_NEAR(band.incident.value, incident, (1e-9 + left_out) * incident) << band.name;
    const double out = band.absorbed_vegetation.value + band.absorbed_soil.value + band.reflected.value + band.unshot;
    EXPECT_NEAR(out, band.incident.value, 1e-9 * incident);
    for (const Estimate& part : {band.absorbed_vegetation, band.absorbed_soil, band.reflected}) {
      EXPECT_GT(part.value, 0.05 * incident);
      EXPECT_LT(part.value, 0.8 * incident);
    }
  }
}

// Light below 1e-290 W counts as none; above, every figure is in proportion.
TEST_F(ExtremeLight, NextToNothingIsInProportionOrNothing) {
  RadiationModel model = black_model(leaves(), unit_plot, beijing_sun());
  const std::vector<Waveband> lights{
      {"one", 1.0, 1.0}, {"faint", 1e-250, 1e-250}, {"none", 1e-305, 1e-305}, {"subnormal", 5e-324, 0.0}, {"dark", 0.0, 0.0}};
  set_lights(model, lights, {0.45, 0.45}, 0.2);
  const RadiationResult result = run(model, fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8}));
  EXPECT_NEAR(result.bands[1].incident.value / 2e-250, 1.0, 1e-9);
  EXPECT_EQ(result.bands[0].ledger.incident, result.bands[1].ledger.incident);
  for (std::size_t b = 2; b < lights.size(); ++b) {
    EXPECT_EQ(result.bands[b].ledger.incident, 0) << b;
    EXPECT_EQ(result.bands[b].absorbed_vegetation.value, 0.0) << b;
  }
}

// A sun on or below the horizon gives no beam: with a sky the run equals the one without a sun, without a sky every flux is
// zero.
TEST_F(ExtremeLight, SunOnOrBelowTheHorizon) {
  RadiationModel model = leaf_model(leaves(), unit_plot, beijing_sun(), std::array{par_band});
  const SolveSettings settings = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8});
  for (const double elevation : {0.0, -1e-9, -5.0, -90.0}) {
    model.sun = sun_at(elevation, 77.0);
    model.sky.reset();
    const RadiationResult dark = run(model, settings);
    EXPECT_EQ(dark.bands[0].ledger.incident, 0) << elevation;
    EXPECT_EQ(dark.bands[0].absorbed_vegetation.value, 0.0);
    EXPECT_TRUE(std::isnan(dark.ground_sunfleck_ratio.value));
    model.sky = SkyModel{.kind = SkyKind::overcast};
    model.bands[0].diffuse_w_m2 = 1.0;
    RadiationModel without_sun = model;
    without_sun.sun.reset();
    EXPECT_TRUE(all_numbers(run(model, settings)) == all_numbers(run(without_sun, settings))) << elevation;
  }
}

// White and transparent leaves stand over white soil under sun and sky: nothing is absorbed, everything comes back out.
TEST_F(ExtremeLight, NothingIsAbsorbedWhereNothingAbsorbs) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    RadiationModel model = black_model(leaves(), plot, beijing_sun());
    const std::vector<Waveband> lights{{"sun", 1.0, 0.0}, {"sky", 0.0, 1.0}, {"both", 1e-12, 1e12}};
    set_lights(model, lights, {}, 1.0);
    for (SurfaceOptics& optics : model.optics) {
      optics.upper = {{0.5, 0.5}, {1.0, 0.0}, {0.1, 0.9}};
      optics.lower = {{0.0, 1.0}, {0.5, 0.5}, {0.7, 0.3}};
    }
    const RadiationResult result = run(model, fixed_scatter(model, {.rays = 2e4, .packets = 1000, .replicates = 8}));
    for (const BandResult& band : result.bands) {
      EXPECT_EQ(band.ledger.absorbed_vegetation, 0) << band.name;
      EXPECT_EQ(band.ledger.absorbed_soil, 0) << band.name;
      EXPECT_EQ(band.ledger.reflected + band.ledger.transmitted + band.ledger.unshot, band.ledger.incident) << band.name;
      EXPECT_LE(band.unshot, 0.1 * 1e-4 * 0.01 * band.incident.value) << band.name;
    }
  }
}

TEST_F(ExtremeLight, BlackScenesEndAtTheFirstLandingUnderTheSkyToo) {
  RadiationModel model = black_model(leaves(), unit_plot, beijing_sun());
  const std::vector<Waveband> lights{{"both", 1.0, 1.0}};
  set_lights(model, lights, {}, 0.0);
  const RadiationResult result = run(model, fixed_scatter(model, {.rays = 4e4, .packets = 1000, .replicates = 8}));
  const FluxLedger& ledger = result.bands[0].ledger;
  EXPECT_EQ(ledger.absorbed_vegetation + ledger.absorbed_soil, ledger.incident);
  EXPECT_EQ(result.indirect.packets, 0U);
}

RadiationModel scattering_stand(double scale) {
  Mesh mesh = random_leaves(40, 0.02, {1.0, 1.5, true}, 1.0, 3);
  for (glm::dvec3& vertex : mesh.vertices) vertex *= scale;
  RadiationModel model = paper_model(mesh, {scale, 1.5 * scale, true}, beijing_sun());
  model.soil->patch_m *= scale;
  return model;
}

// Scaling to a micrometre or eight kilometres by powers of two does not change any rounding, so the same seed gives the same
// ledgers.
TEST_F(ExtremeLight, SizeOfTheSceneDoesNotMatterToTheLastQuantum) {
  const RadiationModel metre = scattering_stand(1.0);
  const RadiationResult expected = run(metre, fixed_scatter(metre, {.rays = 4e4, .packets = 2000, .replicates = 8}));
  for (const double scale : {0x1p-20, 0x1p-10, 0x1p13}) {
    const RadiationModel model = scattering_stand(scale);
    const RadiationResult got = run(model, fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8}));
    for (std::size_t b = 0; b < expected.bands.size(); ++b) {
      EXPECT_EQ(got.bands[b].ledger.absorbed_vegetation, expected.bands[b].ledger.absorbed_vegetation) << scale;
      EXPECT_EQ(got.bands[b].ledger.absorbed_soil, expected.bands[b].ledger.absorbed_soil) << scale;
      EXPECT_EQ(got.bands[b].ledger.reflected, expected.bands[b].ledger.reflected) << scale;
    }
    EXPECT_EQ(got.sunlit_leaf_fraction.value, expected.sunlit_leaf_fraction.value) << scale;
  }
}

// One plate covers the whole plot, over soil: the reflected flux is known (validation.md B2), however large the plot.
TEST_F(ExtremeLight, OnePlateOverPlotsOfAnySize) {
  for (const double size_m : {1e-6, 0.01, 1000.0, 1e4}) {
    for (const double elevation : {0.1, 53.0}) {
      MeshMaker maker;
      maker.level(-0.5 * size_m, 1.5 * size_m, 0.0, size_m, 0.25 * size_m);
      RadiationModel model = leaf_model(maker.mesh(), {size_m, size_m, true}, sun_at(elevation, 30.0), std::array{par_band});
      model.soil->patch_m = 0.1 * size_m;
      const RadiationResult result = run(model, fixed_scatter(model, {.rays = 2e4, .packets = 1000, .replicates = 16}));
      expect_agrees(result.bands[0].reflected, 0.12054990, 16, 2e-4, 8, fmt::format("plot of {} m", size_m).c_str());
    }
  }
}

// One triangle lies over a plot of a kilometre: it intercepts its area, and the flux that it and the soil reflect is known.
TEST_F(ExtremeLight, OneTriangleInAKilometre) {
  MeshMaker maker;
  maker.triangle({256.0, 8.0, 256.0}, {256.0, 8.0, 768.0}, {768.0, 8.0, 256.0});
  for (const double elevation : {90.0, 0.1}) {
    RadiationModel model = black_model(maker.mesh(), {1024.0, 1024.0, true}, sun_at(elevation, 0.0));
    model.soil->patch_m = 16.0;
    const RadiationResult result = run(model, fixed_work(model, 1e5, 16));
    expect_agrees(result.bands[0].absorbed_vegetation, 0.125, 16, 1e-3, 2, "triangle");
  }
}

// A thousand leaves of 4 m stand in a plot of a kilometre, and the same number of 4 mm leaves in one of a metre.
TEST_F(ExtremeLight, ManyLeavesInAKilometre) {
  for (const double size_m : {1024.0, 0.0078125}) {
    const double leaf_m = size_m / 256.0;
    MeshMaker maker;
    Random random(5);
    for (int k = 0; k < 1024; ++k) {
      const int row = k / 32;
      const double x = (k % 32 + random.uniform(0.0, 0.8)) * size_m / 32.0;
      const double z = (row + random.uniform(0.0, 0.8)) * size_m / 32.0;
      maker.level(x, x + leaf_m, z, z + leaf_m, size_m / 512.0);
    }
    for (const double elevation : {90.0, 30.0}) {
      RadiationModel model = black_model(maker.mesh(), {size_m, size_m, true}, sun_at(elevation, 33.0));
      model.soil->patch_m = size_m / 32.0;
      const RadiationResult result = run(model, fixed_work(model, 2e5, 16));
      // Corners lie on a grid of 2^-23 of the plot; leaves measure 2^-8 of it.
      expect_agrees(result.bands[0].absorbed_vegetation, 1024.0 / 65536.0, 16, 3e-4, 4, "small leaves");
    }
  }
}

}  // namespace
}  // namespace sunfleck::test

// Tests the extremes that a scene may contain, each with an exact answer.
#include "support/comparison.h"
#include "support/models.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr std::array elevations_deg = {90.0, 89.9999, 45.0, 1.0, 0.1};
constexpr std::array azimuths_deg = {0.0, 90.0, 180.0, 270.0};

// Calls work(sun) for each of these suns.
template <class Work>
void under_every_sun(const Work& work) {
  for (const double elevation : elevations_deg) {
    for (const double azimuth : azimuths_deg) {
      SCOPED_TRACE(fmt::format("elevation {}, azimuth {}", elevation, azimuth));
      work(sun_at(elevation, azimuth));
    }
  }
}

// Expects every single ray to land on vegetation.
void expect_all_on_vegetation(const RadiationResult& result) {
  EXPECT_GT(result.bands[0].ledger.incident, 0);
  EXPECT_EQ(result.bands[0].ledger.absorbed_vegetation, result.bands[0].ledger.incident);
  EXPECT_EQ(result.lost_rays, 0U);
}

Mesh level_plate(double x0, double x1, double z0, double z1, double y) {
  MeshMaker maker;
  maker.level(x0, x1, z0, z1, y);
  return maker.mesh();
}

// A level plate shades its own area from anywhere: a hundred periods away, and along the borders.
TEST(Extremes, LevelPlateUnderAnySun) {
  const Mesh mesh = level_plate(0.313, 0.713, 0.459, 0.759, 0.8);
  under_every_sun([&](const SunPosition& sun) {
    const RadiationModel model = black_model(mesh, {}, sun);
    const RadiationResult result = simulate(model, fixed_work(model, 2e4, usual_replicates));
    expect_agrees(result.bands[0].absorbed_soil, 0.88, usual_replicates, 1.5e-3, 20, "soil beside the plate");
    EXPECT_EQ(result.lost_rays, 0U);
    EXPECT_EQ(result.elements[0].lower + result.elements[1].lower, 0U);
  });
}

// An isolated plate lies over a plot under the same suns.
TEST(Extremes, IsolatedLevelPlateUnderAnySun) {
  const Mesh mesh = level_plate(0.3, 0.7, 0.4, 0.7, 0.01);
  under_every_sun([&](const SunPosition& sun) {
    const RadiationModel model = black_model(mesh, {1.0, 1.0, false}, sun);
    const RadiationResult result = simulate(model, fixed_work(model, 2e5, usual_replicates));
    expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 2e-3, 20, "plate");
  });
}

TEST(Extremes, LeafLargerThanThePlot) {
  under_every_sun([](const SunPosition& sun) {
    const RadiationModel model = black_model(level_plate(-0.8, 1.9, -0.3, 1.6, 0.5), {}, sun);
    expect_all_on_vegetation(simulate(model, fixed_work(model, 2e4, usual_replicates)));
  });
}

// The leaf is longer than the plot but narrower: its copies lie in one plane, one over the other.
TEST(Extremes, LeafLongerThanThePlot) {
  under_every_sun([](const SunPosition& sun) {
    const RadiationModel model = black_model(level_plate(-0.8, 1.9, 0.25, 0.55, 0.5), {}, sun);
    const RadiationResult result = simulate(model, fixed_work(model, 2e4, usual_replicates));
    expect_agrees(result.bands[0].absorbed_vegetation, 0.3, usual_replicates, 2e-3, 20, "long leaf");
  });
}

TEST(Extremes, LeafAcrossTheCornerOfThePlot) {
  const Mesh mesh = level_plate(-0.1, 0.3, 0.85, 1.15, 0.5);
  for (const double elevation : elevations_deg) {
    const RadiationModel model = black_model(mesh, {}, sun_at(elevation, 33.0));
    const RadiationResult result = simulate(model, fixed_work(model, 2e4, usual_replicates));
    expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 1.5e-3, elevations_deg.size(),
                  "leaf across the corner");
  }
}

// A mesh lying in y = 0 takes precedence over the soil plane, wherever a ray passes into the next period.
TEST(Extremes, MeshInTheGroundWinsOverTheSoil) {
  under_every_sun([](const SunPosition& sun) {
    const RadiationModel full = black_model(level_plate(0.0, 1.0, 0.0, 1.0, 0.0), {}, sun);
    expect_all_on_vegetation(simulate(full, fixed_work(full, 5e4, 8)));
    MeshMaker with_plate;  // makes rays start higher than the ground
    with_plate.organ("leaf", 1, 1);
    with_plate.level(0.0, 1.0, 0.0, 1.0, 0.0);
    with_plate.organ("leaf", 1, 2);
    with_plate.level(0.3, 0.7, 0.4, 0.7, 0.9);
    const RadiationModel shaded = black_model(with_plate.mesh(), {}, sun);
    expect_all_on_vegetation(simulate(shaded, fixed_work(shaded, 2e4, 8)));
    const RadiationModel part = black_model(level_plate(0.3, 0.7, 0.4, 0.7, 0.0), {}, sun);
    expect_agrees(simulate(part, fixed_work(part, 2e4, usual_replicates)).bands[0].absorbed_vegetation, 0.12, usual_replicates,
                  1.5e-3, 20, "plate on the ground");
  });
}

void expect_bare(const RadiationModel& model) {
  const RadiationResult result = simulate(model, fixed_work(model, 1e4, 8));
  EXPECT_NEAR(result.bands[0].absorbed_soil.value, 1.0, model.plot.periodic ? 1e-6 : 1e-2);
  EXPECT_EQ(result.bands[0].ledger.absorbed_soil, result.bands[0].ledger.incident);
  EXPECT_EQ(result.ground_sunfleck_ratio.value, 1.0);
  EXPECT_EQ(result.bands[0].absorbed_vegetation.value, 0.0);
}

TEST(Extremes, NoTriangle) {
  under_every_sun([](const SunPosition& sun) {
    expect_bare(black_model(Mesh{}, {}, sun));
    expect_bare(black_model(Mesh{}, {1.0, 1.0, false}, sun));
  });
}

void add_flat_triangles(MeshMaker& maker) {
  maker.triangle({0.5, 0.9, 0.5}, {0.5, 0.9, 0.5}, {0.5, 0.9, 0.5});
  maker.triangle({0.2, 0.9, 0.2}, {0.8, 0.9, 0.2}, {0.5, 0.9, 0.2});
  maker.triangle({0.2, 0.1, 0.3}, {0.2, 0.9, 0.3}, {0.2, 0.5, 0.3});
}

TEST(Extremes, TrianglesWithoutAreaStopNothing) {
  MeshMaker flat;
  add_flat_triangles(flat);
  expect_bare(black_model(flat.mesh(), {}, beijing_sun()));
  MeshMaker alone;
  alone.level(0.3, 0.7, 0.4, 0.7, 0.9);
  MeshMaker both;
  both.level(0.3, 0.7, 0.4, 0.7, 0.9);
  add_flat_triangles(both);
  const RadiationModel a = black_model(alone.mesh(), {}, beijing_sun());
  const RadiationModel b = black_model(both.mesh(), {}, beijing_sun());
  const RadiationResult got_a = simulate(a, fixed_work(a, 1e5, 8));
  const RadiationResult got_b = simulate(b, fixed_work(b, 1e5, 8));
  EXPECT_EQ(got_a.bands[0].absorbed_vegetation.value, got_b.bands[0].absorbed_vegetation.value);
  for (std::size_t e = 2; e < got_b.elements.size(); ++e) EXPECT_EQ(got_b.elements[e].upper + got_b.elements[e].lower, 0U);
}

TEST(Extremes, OfEqualTrianglesTheFirstIsLit) {
  MeshMaker maker;
  for (int copy = 0; copy < 3; ++copy) maker.level(0.3, 0.7, 0.4, 0.7, 0.9);
  under_every_sun([&](const SunPosition& sun) {
    const RadiationModel model = black_model(maker.mesh(), {}, sun);
    const RadiationResult result = simulate(model, fixed_work(model, 2e4, usual_replicates));
    for (std::size_t e = 2; e < 6; ++e) EXPECT_EQ(result.elements[e].upper + result.elements[e].lower, 0U);
    expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 1.5e-3, 20, "the first of three");
  });
}

// Either of two coplanar triangles with different shapes may be hit: together they shade what the larger one shades.
TEST(Extremes, CoplanarTrianglesShadeTheirUnion) {
  MeshMaker maker;
  maker.level(0.3, 0.7, 0.4, 0.7, 0.9);
  maker.level(0.3, 0.5, 0.4, 0.6, 0.9);
  const RadiationModel model = black_model(maker.mesh(), {}, beijing_sun());
  const RadiationResult result = simulate(model, fixed_work(model, 1e5, usual_replicates));
  expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 4e-4, 1, "union");
}

RadiationModel scaled_leaves(double scale, const glm::dvec3& shift_m) {
  const Plot plot{1.0, 1.5, true};
  Mesh mesh = random_leaves(40, 0.02, plot, 1.0, 3);
  for (glm::dvec3& vertex : mesh.vertices) vertex = vertex * scale + shift_m;
  RadiationModel model = black_model(mesh, {plot.size_x_m * scale, plot.size_z_m * scale, true}, beijing_sun());
  model.soil->patch_m *= scale;
  return model;
}

// The same seed sends the same rays: only the rounding of corners may move a few of them.
void expect_same_shares(const RadiationModel& model, const RadiationModel& other) {
  const RadiationResult a = simulate(model, fixed_work(model, 5e5, 8));
  const RadiationResult b = simulate(other, fixed_work(other, 5e5, 8));
  EXPECT_NEAR(a.bands[0].absorbed_vegetation.value, b.bands[0].absorbed_vegetation.value, 2e-5);
  EXPECT_NEAR(a.sunlit_leaf_fraction.value, b.sunlit_leaf_fraction.value, 1e-4);
  EXPECT_NEAR(a.leaf_area_index, b.leaf_area_index, 1e-5);
  EXPECT_EQ(b.lost_rays, 0U);
}

TEST(Extremes, SizeOfTheSceneDoesNotMatter) {
  for (const double scale : {1e-6, 1e-3, 1e4}) {
    SCOPED_TRACE(scale);
    expect_same_shares(scaled_leaves(1.0, {}), scaled_leaves(scale, {}));
  }
}

TEST(Extremes, MeshAKilometreAwayIsWrappedIntoThePlot) {
  expect_same_shares(scaled_leaves(1.0, {}), scaled_leaves(1.0, {-1000.0, 0.0, 1500.0}));
}

TEST(Extremes, MeshAKilometreUp) {
  for (const double elevation : {90.0, 30.0}) {
    const RadiationModel model = black_model(level_plate(0.3, 0.7, 0.4, 0.7, 1000.0), {}, sun_at(elevation, 33.0));
    const RadiationResult result = simulate(model, fixed_work(model, 1e4, usual_replicates));
    expect_agrees(result.bands[0].absorbed_vegetation, 0.12, usual_replicates, 2e-3, 2, "plate a kilometre up");
    EXPECT_EQ(result.lost_rays, 0U);
  }
}

// The mesh is isolated, a kilometre from the plot's corner: it receives the light of its own area.
TEST(Extremes, IsolatedMeshAKilometreAway) {
  const RadiationModel model =
      black_model(level_plate(1000.0, 1100.0, 1000.0, 1080.0, 3.0), {100.0, 100.0, false}, beijing_sun());
  RadiationModel finer = model;
  finer.soil->patch_m = 5.0;
  const RadiationResult result = simulate(finer, fixed_work(finer, 4e6, usual_replicates));
  expect_agrees(result.bands[0].absorbed_vegetation, 0.8, usual_replicates, 5e-3, 1, "plate beside the plot");
}

TEST(Extremes, IrradianceOfAnySizeInTwentyBands) {
  RadiationModel model = black_model(level_plate(0.313, 0.713, 0.459, 0.759, 0.8), {}, beijing_sun());
  model.bands.clear();
  for (int band = 0; band < 20; ++band)
    model.bands.push_back({fmt::format("band{}", band), std::pow(10.0, 24.0 * band / 19.0 - 12.0), 0.0});
  for (SurfaceOptics& optics : model.optics) optics.upper = optics.lower = std::vector<FaceOptics>(20);
  model.soil->reflectance.assign(20, 0.0);
  const RadiationResult result = simulate(model, fixed_work(model, 1e5, usual_replicates));
  ASSERT_EQ(result.bands.size(), 20U);
  for (std::size_t band = 0; band < 20; ++band) {
    const double direct_w_m2 = model.bands[band].direct_w_m2;
    const Estimate share = result.bands[band].absorbed_soil.scaled(1.0 / direct_w_m2);
    EXPECT_NEAR(share.value, result.bands[0].absorbed_soil.value / model.bands[0].direct_w_m2, 1e-12);
    EXPECT_NEAR(result.organs[0].direct[band].value * result.organs[0].area_m2, result.bands[band].absorbed_vegetation.value,
                1e-9 * direct_w_m2);
    EXPECT_EQ(result.bands[band].ledger.residual(), 0);
    if (band == 19) expect_agrees(share, 0.88, usual_replicates, 4e-4, 1, "soil at 1e12 W m-2");
  }
  EXPECT_NEAR(model.bands[0].direct_w_m2, 1e-12, 1e-24);
}

}  // namespace
}  // namespace sunfleck::test

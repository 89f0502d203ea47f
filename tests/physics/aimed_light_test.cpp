// A small stand on a wide plot: light is aimed at it, so that its own figures are exact, and nothing else changes.
#include "physics/transport/model/stand_aim.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sunfleck::test {
namespace {

constexpr Plot own_plot{0.2, 0.2, false};
constexpr Plot wide_plot{4.0, 3.0, false};

// Returns leaves 0.1 m high, under sun and sky, in a corner of a plot that is as wide as they are or far wider.
RadiationModel few_leaves(const Plot& plot, bool black_soil) {
  RadiationModel model = paper_model(random_leaves(25, 6e-4, own_plot, 0.1, 4), plot, sun_at(45.0, 130.0));
  if (black_soil) model.soil->reflectance = {0.0, 0.0};
  model.sky = SkyModel{};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.4;
  return model;
}

SolveSettings to_bounds(double bound, std::uint64_t seed) {
  SolveSettings settings;
  settings.accuracy.direct = bound;
  settings.accuracy.indirect = bound;
  settings.seed = seed;
  return settings;
}

// Returns a flux per ground area in W of the whole plot.
Estimate in_watts(const RadiationModel& model, const Estimate& per_ground) {
  return per_ground.scaled(model.plot.area_m2());
}

TEST(AimedLight, IsForSmallStandsAloneOnTheirPlots) {
  const auto aims = [](const RadiationModel& model) { return make_stand_aim(model, make_counter_layout(model)).has_value(); };
  EXPECT_TRUE(aims(few_leaves(wide_plot, false)));
  EXPECT_FALSE(aims(few_leaves(own_plot, false)));
  EXPECT_FALSE(aims(few_leaves({4.0, 3.0, true}, false)));
  RadiationModel mapped = few_leaves(wide_plot, false);
  mapped.planes = {{0.05, 10, 10}};
  EXPECT_FALSE(aims(mapped));
  EXPECT_FALSE(aims(black_model({}, wide_plot, sun_at(45.0, 130.0))));
}

TEST(AimedLight, SpendsFewerPacketsFarFromTheStand) {
  const RadiationModel model = few_leaves(wide_plot, false);
  const StandAim aim = make_stand_aim(model, make_counter_layout(model)).value();
  const auto part = [&](double distance_m) {
    const glm::vec3 point_m(aim.centre_m + glm::dvec3(distance_m, 0.0, 0.0));
    return static_cast<double>(shared::aimed_part(aim.sphere(), point_m)) * 0x1p-32;
  };
  EXPECT_EQ(part(0.0), 1.0);
  double last = 1.0;
  for (const double distance_m : {0.3, 0.6, 1.2, 4.0}) {
    EXPECT_LT(part(distance_m), last);
    EXPECT_NEAR(part(distance_m), std::pow(aim.radius_m / distance_m, 1.5), 1e-6);
    last = part(distance_m);
  }
  EXPECT_EQ(part(1e9), 0x1p-10);
}

// Black soil sends nothing back, so that the leaves of an isolated stand get the same light on a plot of any size.
TEST(AimedLight, OverBlackSoilIsThatOnAPlotOfTheStandsOwnSize) {
  const RadiationModel wide = few_leaves(wide_plot, true), own = few_leaves(own_plot, true);
  const RadiationResult aimed = simulate(wide, to_bounds(0.005, 1));
  const RadiationResult even = simulate(own, to_bounds(0.005, 2));
  const std::size_t replicates = std::min(aimed.direct.replicates, even.direct.replicates);
  for (std::size_t b = 0; b < wide.bands.size(); ++b) {
    const Estimate got = in_watts(wide, aimed.bands[b].absorbed_vegetation);
    const Estimate expected = in_watts(own, even.bands[b].absorbed_vegetation);
    expect_same(got, expected, replicates, 0.005 * expected.value, 29, "absorbed by leaves");
    EXPECT_LE(got.half_width, 0.005 * got.value);
    EXPECT_EQ(aimed.bands[b].ledger.residual(), 0);
  }
  for (std::size_t organ = 0; organ < aimed.organs.size(); ++organ) {
    const OrganResult& got = aimed.organs[organ];
    const OrganResult& expected = even.organs[organ];
    expect_same(got.absorbed[0], expected.absorbed[0], replicates, 0.05 * expected.absorbed[0].value, 29, "absorbed by a leaf");
  }
}

// The figures of evenly spread rays are exact for the soil and noisy for the leaves.
TEST(AimedLight, OverReflectingSoilIsThatOfEvenlySpreadRays) {
  const RadiationModel model = few_leaves(wide_plot, false);
  const RadiationResult aimed = simulate(model, to_bounds(0.01, 1));
  const RadiationResult even = simulate(model, fixed_scatter(model, {.rays = 4e6, .packets = 1e5, .bound = 1e-3}));
  EXPECT_LT(aimed.direct.rays, even.direct.rays);
  const std::size_t replicates = std::min(aimed.direct.replicates, even.direct.replicates);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const BandResult& got = aimed.bands[b];
    const BandResult& expected = even.bands[b];
    EXPECT_LE(got.absorbed_vegetation.half_width, 0.01 * got.absorbed_vegetation.value);
    const double all = got.incident.value;
    // Nearly all of it lands on the soil, and both vary with the number of rays that meet the plot.
    EXPECT_NEAR(all / expected.incident.value, 1.0, 2.0 * got.absorbed_soil.half_width / got.absorbed_soil.value);
    expect_same(got.absorbed_vegetation, expected.absorbed_vegetation, replicates, 0.05 * expected.absorbed_vegetation.value, 6,
                "absorbed by leaves");
    expect_same(got.absorbed_soil, expected.absorbed_soil, replicates, 0.005 * all, 6, "absorbed by soil");
    expect_same(got.reflected, expected.reflected, replicates, 0.005 * all, 6, "reflected");
    EXPECT_EQ(got.ledger.residual(), 0);
  }
  EXPECT_NEAR(soil_irradiance_w_m2(model, aimed, 0) / soil_irradiance_w_m2(model, even, 0), 1.0, 5e-3);
}

// Which rays meet an isolated stand is a matter of chance. Of 64 runs with 8 replicates the variance is known with a relative standard
// error of sqrt(2 / 63), the mean of their own variances with one of sqrt(2 / 448): 0.19 together.
TEST(AimedLight, IncidentFluxVariesAsItsErrorSays) {
  const RadiationModel model = few_leaves(wide_plot, false);
  const Prepared prepared(model);
  constexpr int runs = 64;
  ReplicateMean values;
  double variance = 0.0;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const ScatterWork work{.rays = 2e4, .packets = 500, .replicates = 8, .seed = seed, .bound = 0.01};
    const RadiationResult result = simulate(model, prepared, fixed_scatter(model, work));
    const BandResult& band = result.bands[0];
    EXPECT_GT(band.incident.half_width, 0.0);
    values.add(band.incident.value);
    variance += std::pow(band.incident.half_width / t_quantile(0.95, 8), 2.0) / runs;
  }
  const double seen = std::pow(values.standard_error(), 2.0) * runs;
  EXPECT_NEAR(seen / variance, 1.0, 4.0 * 0.19);
}

// Without its own bound the light of a few leaves in an endless plot would be judged against what falls on the plot.
TEST(JudgedError, OfSparseLeavesIsTheirOwn) {
  const RadiationModel model = paper_model(random_leaves(10, 1e-4, unit_plot, 0.1, 4), unit_plot, sun_at(45.0, 130.0));
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RadiationResult result = simulate(model, to_bounds(0.05, seed));
    ASSERT_EQ(result.stop, StopReason::bound_reached);
    for (const BandResult& band : result.bands) {
      EXPECT_GT(band.absorbed_vegetation.value, 0.0);
      EXPECT_LE(band.absorbed_vegetation.half_width, 0.05 * band.absorbed_vegetation.value);
    }
  }
}

// Returns a level leaf of 1 m2 in the middle of a square plot, 0.5 m above its soil.
RadiationModel leaf_over_floor(double side_m, double soil_reflectance) {
  MeshMaker maker;
  maker.organ("leaf");
  const double middle_m = 0.5 * side_m;
  maker.level(middle_m - 0.5, middle_m + 0.5, middle_m - 0.5, middle_m + 0.5, 0.5);
  RadiationModel model = paper_model(maker.mesh(), {side_m, side_m, false}, sun_at(90.0, 0.0));
  for (double& reflectance : model.soil->reflectance) reflectance = soil_reflectance;
  return model;
}

// On black soil nothing comes back to the leaf, and a packet carries a part of what the leaf scatters: a few thousand of them show that
// it gets next to nothing.
TEST(JudgedError, OfALeafOverABlackFloorNeedsFewPackets) {
  const RadiationResult result = simulate(leaf_over_floor(50.0, 0.0), to_bounds(0.01, 1));
  EXPECT_EQ(result.stop, StopReason::bound_reached);
  EXPECT_LT(result.indirect.packets, 1'000'000U);
}

// What the floor sends up to the leaf starts at the few landings near it, so that beam rays must not stay behind the packets.
TEST(JudgedError, OfALeafOverAWideFloorIsReachedWithEnoughLandings) {
  const RadiationResult result = simulate(leaf_over_floor(20.0, 0.15), to_bounds(0.02, 1));
  EXPECT_EQ(result.stop, StopReason::bound_reached);
  EXPECT_GE(8.0 * result.work.rays, result.work.packets);
  EXPECT_LT(result.indirect.packets, 3'000'000U);
}

// A leaf below an opaque roof gets next to nothing, and the run still ends.
TEST(JudgedError, OfAShadedLeafReachesItsBound) {
  MeshMaker maker;
  maker.organ("roof");
  maker.level(-0.5, 1.5, -0.5, 1.5, 0.5);
  maker.organ("leaf");
  maker.level(0.4, 0.6, 0.4, 0.6, 0.2);
  RadiationModel model = black_model(maker.mesh(), unit_stand, sun_at(90.0, 0.0));
  const RadiationResult result = simulate(model, to_bounds(0.05, 1));
  EXPECT_EQ(result.stop, StopReason::bound_reached);
  EXPECT_EQ(result.bands[0].ledger.absorbed_vegetation, 0);
}

}  // namespace
}  // namespace sunfleck::test

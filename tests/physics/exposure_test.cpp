// Tests which shares are sunlit, which are not, and which are undefined: leaves that the beam cannot hit have no share, and a
// share on which all rays agree has the interval that their number allows.
#include "support/comparison.h"
#include "support/models.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

constexpr int exposure_replicates = 16;
const Plot endless{1.0, 1.0, true};
const Plot isolated{1.0, 1.0, false};

// Upper 95 % limit of a Poisson mean when no event was seen.
constexpr double unseen = 3.6888794541139363;

RadiationResult run_beam(const RadiationModel& model, double rays = 160'000.0) {
  return simulate(model, fixed_work(model, rays, exposure_replicates));
}

void expect_none(const Estimate& estimate) {
  EXPECT_TRUE(std::isnan(estimate.value)) << estimate.value;
  EXPECT_TRUE(std::isnan(estimate.half_width)) << estimate.half_width;
}

// Returns a level leaf of 0.16 m2, and one of 0.24 m2 that stands in the plane of a beam from the east.
RadiationModel edge_on_model(const Plot& plot, double azimuth_deg = 90.0) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.3, 0.7, 0.3, 0.7, 0.8);
  maker.organ("leaf", 1, 2);
  maker.quad({0.1, 0.1, 0.2}, {0.1, 0.1, 0.8}, {0.1, 0.5, 0.8}, {0.1, 0.5, 0.2});
  return black_model(maker.mesh(), plot, sun_at(40.0, azimuth_deg));
}

TEST(EdgeOnLeaf, HasNoSunlitShareAndIsLeftOutOfTheTotals) {
  for (const Plot& plot : {endless, isolated}) {
    const RadiationResult result = run_beam(edge_on_model(plot));
    expect_agrees(result.organs[0].sunlit_fraction, 1.0, exposure_replicates, 0.01, 2, "level leaf");
    expect_none(result.organs[1].sunlit_fraction);
    expect_agrees(result.sunlit_leaf_fraction, 1.0, exposure_replicates, 0.01, 2, "all leaves");
    EXPECT_NEAR(result.leaf_area_index, 0.16 + 0.24, 1e-6);
    // This one of the 20 layers up to 0.8 m holds only the standing leaf.
    expect_none(result.layers[5].sunlit_leaf_fraction);
  }
}

// A ray or none meets a leaf whose plane the beam misses by 0.01 degrees: where none does, the other leaf's rays tell nothing
// of it.
TEST(EdgeOnLeaf, IsNotTakenForShadeIfItIsNearlySo) {
  constexpr int runs = 60;
  const RadiationModel model = edge_on_model(endless, 90.01);
  int unmet = 0, held = 0, plant_held = 0, classes_held = 0;
  const auto holds = [](const Estimate& share) { return std::abs(share.value - 1.0) <= share.half_width; };
  for (int run = 0; run < runs; ++run) {
    SolveSettings settings = fixed_work(model, 16'000.0, exposure_replicates);
    settings.seed = static_cast<std::uint64_t>(run) + 1;
    const RadiationResult result = simulate(model, settings);
    unmet += result.organs[1].direct[0].value == 0.0 ? 1 : 0;
    held += holds(result.sunlit_leaf_fraction) ? 1 : 0;
    plant_held += holds(result.plants[0].sunlit_leaf_fraction) ? 1 : 0;
    const Estimate& lit_m2 = result.leaf_classes.sunlit_m2;
    classes_held += holds({lit_m2.value / 0.4, lit_m2.half_width / 0.4}) ? 1 : 0;
  }
  EXPECT_GT(unmet, runs / 5);
  EXPECT_LT(unmet, runs * 4 / 5);
  const double least = 0.95 * runs - 3.0 * std::sqrt(0.95 * 0.05 * runs);
  EXPECT_GE(held, least);
  EXPECT_GE(plant_held, least);
  EXPECT_GE(classes_held, least);
}

TEST(CopiedLeaf, HasNoSunlitShareAndItsOriginalTakesAllLight) {
  MeshMaker maker;
  for (int rank = 1; rank <= 2; ++rank) {
    maker.organ("leaf", 1, rank);
    maker.level(0.3, 0.7, 0.3, 0.7, 0.8);
  }
  const RadiationModel model = black_model(maker.mesh(), endless, beijing_sun());
  const RadiationResult result = run_beam(model);
  expect_agrees(result.organs[0].sunlit_fraction, 1.0, exposure_replicates, 0.01, 3, "first leaf");
  expect_agrees(share_of_beam(model, result, 0), 0.16, exposure_replicates, 1e-3, 3, "flux on the first leaf");
  expect_none(result.organs[1].sunlit_fraction);
  EXPECT_EQ(result.organs[1].absorbed[0].value, 0.0);
  EXPECT_EQ(result.organs[1].absorbed[0].half_width, 0.0) << "that nothing reaches it is known";
  expect_agrees(result.sunlit_leaf_fraction, 1.0, exposure_replicates, 0.01, 3, "all leaves");
}

TEST(BuriedLeaf, HasNoSunlitShare) {
  for (const Plot& plot : {endless, isolated}) {
    MeshMaker maker;
    maker.organ("leaf", 1, 1);
    maker.level(0.3, 0.7, 0.3, 0.7, 0.8);
    maker.organ("leaf", 1, 2);
    maker.level(0.4, 0.6, 0.4, 0.6, -0.1);
    const RadiationResult result = run_beam(black_model(maker.mesh(), plot, beijing_sun()));
    expect_none(result.organs[1].sunlit_fraction);
    expect_agrees(result.sunlit_leaf_fraction, 1.0, exposure_replicates, 0.01, 1, "all leaves");
  }
}

// The leaf lies below the plane of an isolated plot's soil but beside its rectangle: the beam comes down past the soil's edge.
TEST(BuriedLeaf, IsLitBesideThePlot) {
  MeshMaker maker;
  maker.level(1.1, 1.3, 0.4, 0.6, -0.05);
  const RadiationResult result = run_beam(black_model(maker.mesh(), isolated, sun_at(90.0, 0.0)));
  expect_agrees(result.organs[0].sunlit_fraction, 1.0, exposure_replicates, 0.01, 1, "leaf beside the plot");
}

// Rays are aimed at the leaf, and hardly any meets the small plot far away from it.
TEST(FarPlot, IsNotTakenForNothing) {
  MeshMaker maker;
  maker.level(1000.0, 1000.5, 1000.0, 1000.5, 0.5);
  RadiationModel model = black_model(maker.mesh(), isolated, sun_at(90.0, 0.0));
  model.soil->reflectance = {0.2};
  SolveSettings settings;
  settings.accuracy.direct = settings.accuracy.indirect = 0.01;
  settings.max_rays = 300'000;
  const RadiationResult result = simulate(model, settings);
  ASSERT_EQ(result.stop, StopReason::rays_spent);
  ASSERT_EQ(result.ground_sunfleck_ratio.value, 0.0);
  EXPECT_GE(result.bands[0].incident.value + result.bands[0].incident.half_width, 1.25);
  EXPECT_GE(result.bands[0].reflected.value + result.bands[0].reflected.half_width, 0.2);
}

TEST(ShareWithoutABeam, IsNone) {
  RadiationModel model = edge_on_model(endless);
  model.bands[0].direct_w_m2 = 0.0;
  model.bands[0].diffuse_w_m2 = 1.0;
  model.sky = SkyModel{};
  const RadiationResult result = run_beam(model, 16'000.0);
  for (const OrganResult& organ : result.organs) expect_none(organ.sunlit_fraction);
  expect_none(result.sunlit_leaf_fraction);
  expect_none(result.ground_sunfleck_ratio);
}

// A leaf in full shade below a plate that fills the plot: no ray meets leaf or soil. The number of rays that would have met
// them determines how certain that is.
class FullShade : public ::testing::Test {
 protected:
  static RadiationModel model() {
    MeshMaker maker;
    maker.organ("leaf", 1, 1);
    maker.level(0.0, 1.0, 0.0, 1.0, 1.0);
    maker.organ("leaf", 1, 2);
    maker.level(0.4, 0.6, 0.4, 0.6, 0.5);
    return black_model(maker.mesh(), endless, sun_at(90.0, 0.0));
  }
};

TEST_F(FullShade, HasTheIntervalThatTheRaysAllow) {
  const RadiationResult result = run_beam(model());
  const auto rays = static_cast<double>(result.direct.rays);
  const OrganResult& leaf = result.organs[1];
  EXPECT_EQ(leaf.sunlit_fraction.value, 0.0);
  EXPECT_NEAR(leaf.sunlit_fraction.half_width, unseen / (0.04 * rays), 1e-3 * unseen / (0.04 * rays));
  EXPECT_EQ(leaf.direct[0].value, 0.0);
  EXPECT_NEAR(leaf.direct[0].half_width, unseen / (0.04 * rays), 1e-3 * unseen / (0.04 * rays));
  EXPECT_NEAR(leaf.absorbed[0].half_width, unseen / (0.04 * rays), 1e-3 * unseen / (0.04 * rays));
  for (const Estimate& share : {result.ground_sunfleck_ratio, result.layers[0].sunfleck_ratio}) {
    EXPECT_EQ(share.value, 0.0);
    EXPECT_NEAR(share.half_width, unseen / rays, 1e-6 * unseen / rays);
  }
  EXPECT_EQ(result.bands[0].absorbed_soil.value, 0.0);
  EXPECT_NEAR(result.bands[0].absorbed_soil.half_width, unseen / rays, 1e-6 * unseen / rays);
  // All rays land on the plate: its share may fall short of 1 by the same amount.
  EXPECT_EQ(result.bands[0].absorbed_vegetation.value, 1.0);
  EXPECT_NEAR(result.bands[0].absorbed_vegetation.half_width, unseen / rays, 1e-6 * unseen / rays);
}

TEST_F(FullShade, IsCertainWhereNothingCouldBeOtherwise) {
  RadiationModel open = model();
  open.canopy = {};
  open.canopy.period_m = {1.0, 1.0};
  const RadiationResult result = run_beam(open, 16'000.0);
  EXPECT_EQ(result.ground_sunfleck_ratio.value, 1.0);
  EXPECT_EQ(result.ground_sunfleck_ratio.half_width, 0.0);
  EXPECT_EQ(result.bands[0].absorbed_vegetation.half_width, 0.0);
  EXPECT_EQ(result.bands[0].reflected.half_width, 0.0);  // because the soil is black
  const RadiationResult below = run_beam(model(), 16'000.0);
  EXPECT_EQ(below.layers.back().sunfleck_ratio.value, 1.0);
  EXPECT_EQ(below.layers.back().sunfleck_ratio.half_width, 0.0);
}

// Uses so few rays that any share is compatible with none of them landing on the leaf.
TEST_F(FullShade, IsUnknownWhereTooFewRaysCouldTell) {
  const RadiationResult result = run_beam(model(), 64.0);  // 2.6 rays would land on the leaf in full sun
  expect_none(result.organs[1].sunlit_fraction);
}

// The interval has to hold where a share is small but not 0: on a leaf in shade except for a slit, the rays of most runs miss
// the slit. Over 400 seeds at least 95 % of the intervals contain the true share, within the scatter of 400 draws.
TEST(AlmostFullShade, IntervalsCover) {
  constexpr double slit = 0.004;
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.0, 1.0 - slit, 0.0, 1.0, 1.0);
  maker.organ("leaf", 1, 2);
  maker.level(0.5, 1.0, 0.0, 1.0, 0.5);
  const RadiationModel model = black_model(maker.mesh(), endless, sun_at(90.0, 0.0));
  const Prepared prepared(model);
  int covered = 0;
  int without_spread = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Estimate share = simulate(model, prepared, fixed_work(model, 288.0, 8, seed)).organs[1].sunlit_fraction;
    without_spread += share.value == 0.0 ? 1 : 0;
    covered += std::abs(share.value - 2.0 * slit) <= share.half_width ? 1 : 0;
  }
  EXPECT_GT(without_spread, 40) << "else the test says nothing";
  EXPECT_GE(covered, 366);
}

}  // namespace
}  // namespace sunfleck::test

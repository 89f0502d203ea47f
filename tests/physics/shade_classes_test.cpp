// The sunlit and the shaded class of leaf area, and what each absorbs.

#include "physics/transport/solve/shade_classes.h"

#include "base/random.h"
#include "support/leaf_scenes.h"
#include "support/light_mix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sunfleck::test {
namespace {

// Returns the flux that both classes absorb, W.
double absorbed_w(const ShadeClassResult& classes, std::size_t band) {
  const auto of = [](const Estimate& area_m2, const Estimate& absorbed) {
    return std::isnan(absorbed.value) ? 0.0 : area_m2.value * absorbed.value;
  };
  return of(classes.sunlit_m2, classes.absorbed_sunlit[band]) + of(classes.shaded_m2, classes.absorbed_shaded[band]);
}

TEST(ShadeClasses, AddUpToWhatOrgansLayersAndLeavesAbsorb) {
  const RadiationModel model = light_mix();
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 2e6, .packets = 2e4}));
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    double organs_w = 0.0;
    for (const OrganResult& organ : result.organs) {
      const double expected_w = organ.absorbed[b].value * organ.area_m2;
      // A class too small to be seen has no value, and takes what little it absorbs along.
      const bool both = !std::isnan(organ.classes.absorbed_sunlit[b].value + organ.classes.absorbed_shaded[b].value);
      EXPECT_NEAR(absorbed_w(organ.classes, b), expected_w, (both ? 1e-9 : 0.1) * expected_w);
      organs_w += expected_w;
    }
    double layers_w = 0.0;
    for (const LayerResult& layer : result.layers) {
      if (!layer.absorbed.empty()) layers_w += absorbed_w(layer.leaf_classes, b);
    }
    EXPECT_NEAR(layers_w, organs_w, 0.02 * organs_w);
    EXPECT_NEAR(absorbed_w(result.leaf_classes, b), organs_w, 1e-9 * organs_w);
  }
}

// Everything on a level black leaf in the open absorbs the whole beam, but the leaf's own absorption is known to a percent.
TEST(ShadeClasses, OfALeafWhollyInTheSunIncludeTheBeam) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.polygon({0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}, 0.16, 4, 0.3);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(60.0, 90.0));
  const Prepared prepared(model);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RadiationResult result = simulate(model, prepared, fixed_work(model, 2e3, usual_replicates, seed));
    for (const ShadeClassResult* classes : {&result.organs[0].classes, &result.leaf_classes}) {
      const Estimate sunlit = classes->absorbed_sunlit[0];
      ASSERT_FALSE(std::isnan(sunlit.value));
      EXPECT_LE(std::abs(sunlit.value - model.bands[0].direct_w_m2), sunlit.half_width + 1e-9) << seed;
    }
  }
}

// All replicates agree that no ray met this leaf, which is wholly in the sun: neither of its classes is known to be there.
TEST(ShadeClasses, ThatMayBeNothingHaveNoValues) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.polygon({0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}, 1e-6, 4, 0.3);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(60.0, 90.0));
  const ShadeClassResult& classes = simulate(model, fixed_work(model, 1e3)).organs[0].classes;
  EXPECT_EQ(classes.sunlit_m2.value, 0.0);
  EXPECT_GE(classes.sunlit_m2.half_width, 1e-6 * (1.0 - 1e-6));
  for (const auto* of : {&classes.absorbed_sunlit, &classes.absorbed_shaded, &classes.sunlit_sd, &classes.shaded_sd}) {
    EXPECT_TRUE(std::isnan(of->at(0).value));
    EXPECT_TRUE(std::isnan(of->at(0).half_width));
  }
}

// In a short run the flux of a small class is mostly noise. It stays between nothing and what its organ absorbs.
TEST(ShadeClasses, ArePossible) {
  RadiationModel model = light_mix();
  model.plot.periodic = false;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    SolveSettings settings = fixed_scatter(model, {.rays = 2e4, .packets = 500});
    settings.seed = seed;
    for (const OrganResult& organ : simulate(model, settings).organs) {
      const ShadeClassResult& classes = organ.classes;
      for (std::size_t b = 0; b < model.bands.size(); ++b) {
        const double organ_w = organ.absorbed[b].value * organ.area_m2 * (1.0 + 1e-12);
        for (const auto& [area, absorbed] : {std::pair(classes.sunlit_m2, classes.absorbed_sunlit[b]),
                                             std::pair(classes.shaded_m2, classes.absorbed_shaded[b])}) {
          if (std::isnan(absorbed.value)) continue;
          EXPECT_GE(absorbed.value, 0.0);
          EXPECT_LE(absorbed.value * area.value, organ_w);
        }
        if (classes.shaded_m2.value == 0.0 && !std::isnan(classes.absorbed_sunlit[b].value)) {
          EXPECT_NEAR(classes.absorbed_sunlit[b].value, organ.absorbed[b].value, 1e-9 * organ.absorbed[b].value);
        }
      }
    }
  }
}

// A level black leaf with another of half its size right above: half of the lower one is sunlit.
TEST(ShadeClasses, OfALeafInHalfShade) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.2, 0.8, 0.2, 0.8, 0.5);
  maker.organ("leaf", 1, 2);
  maker.level(0.2, 0.8, 0.2, 0.5, 0.6);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(90.0, 180.0));
  const RadiationResult result = simulate(model, fixed_work(model, 2e5));
  const double full_sun_w_m2 = model.bands[0].direct_w_m2;
  for (const OrganResult& organ : result.organs) {
    const ShadeClassResult& classes = organ.classes;
    EXPECT_NEAR(classes.sunlit_m2.value, 0.18, 2.0 * classes.sunlit_m2.half_width + 1e-6);
    EXPECT_NEAR(classes.sunlit_m2.value + classes.shaded_m2.value, organ.area_m2, 1e-9);
    EXPECT_NEAR(classes.absorbed_sunlit[0].value, full_sun_w_m2, 1e-6 * full_sun_w_m2);
    if (organ.area_m2 > 0.2) {
      EXPECT_EQ(classes.absorbed_shaded[0].value, 0.0);
    }
  }
}

// Upright leaves, all of whose area is sunlit, under a high sun: few rays of a coarse grid meet any of them. Where none does, the
// interval of both areas knows how much of the leaf no ray would have shown.
TEST(ShadeClasses, OfUprightLeavesThatNoRayMeets) {
  MeshMaker maker;
  constexpr double leaf_m2 = 0.2 * 0.02;
  for (int leaf = 0; leaf < 20; ++leaf) {
    const double x = 0.1 + 0.16 * (leaf % 5), z = 0.1 + 0.2 * (leaf / 5);
    maker.organ("leaf", 1, leaf + 1);
    maker.quad({x, 0.5, z}, {x, 0.5, z + 0.02}, {x, 0.7, z + 0.02}, {x, 0.7, z});
  }
  const RadiationModel model = black_model(maker.mesh(), {1.0, 1.0, false}, sun_at(85.0, 180.0));
  std::size_t unmet = 0, outside = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SolveSettings settings = fixed_work(model, 1500.0, 8);
    settings.seed = seed;
    for (const OrganResult& organ : simulate(model, settings).organs) {
      const Estimate& sunlit_m2 = organ.classes.sunlit_m2;
      if (sunlit_m2.value > 0.0) continue;
      ++unmet;
      EXPECT_EQ(organ.classes.shaded_m2.half_width, sunlit_m2.half_width);
      if (sunlit_m2.half_width < 0.999 * leaf_m2) ++outside;
    }
  }
  EXPECT_GT(unmet, 20U);
  EXPECT_EQ(outside, 0U);
}

// A leaf of two triangles rises through all layers, and its lower half lies in the shade of a leaf right above it. Light of the sky
// is taken to be even over each triangle, so that each layer's sunlit and shaded leaf area absorb about the same of it.
TEST(ShadeClasses, OfALeafInTheShadeOfSomeLayers) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.triangle({0.2, 0.0, 0.3}, {0.8, 1.0, 0.3}, {0.8, 1.0, 0.7});
  maker.triangle({0.2, 0.0, 0.3}, {0.8, 1.0, 0.7}, {0.2, 0.0, 0.7});
  maker.organ("leaf", 1, 2);
  maker.level(0.2, 0.5, 0.3, 0.7, 1.02);
  RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(90.0, 180.0));
  model.layers = 8;
  model.sky = SkyModel{};
  model.bands[0].diffuse_w_m2 = model.bands[0].direct_w_m2;
  const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e6, .packets = 1e5}));
  const OrganResult& leaf = result.organs.front();
  const double sky_w_m2 = leaf.classes.absorbed_shaded[0].value;
  const double both_w_m2 = leaf.classes.absorbed_sunlit[0].value;
  for (std::size_t k = 0; k + 1 < 8; ++k) {
    const ShadeClassResult& classes = result.layers[k].leaf_classes;
    if (k < 4) {
      EXPECT_NEAR(classes.absorbed_shaded[0].value, sky_w_m2, 0.1 * sky_w_m2) << k;
    } else if (k > 4) {
      EXPECT_NEAR(classes.absorbed_sunlit[0].value, both_w_m2, 0.1 * sky_w_m2) << k;
    }
  }
}

// One leaf with a level half and a half inclined by 60 degrees, which absorbs half as much per area.
TEST(ShadeClasses, KnowHowUnequalTheSunlitAreaIs) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.polygon({0.25, 0.5, 0.25}, inclined(0.0, 0.0), 0.03, 4, 0.0);
  maker.polygon({0.75, 0.5, 0.75}, inclined(radians(60.0), 0.0), 0.03, 4, 0.0);
  maker.organ("leaf", 1, 2);
  maker.polygon({0.75, 0.5, 0.25}, inclined(radians(60.0), 1.0), 0.02, 4, 0.0);
  const RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(90.0, 180.0));
  const RadiationResult result = simulate(model, fixed_work(model, 2e5));
  const double full_sun_w_m2 = model.bands[0].direct_w_m2;
  const Estimate mixed = result.organs[0].classes.sunlit_sd[0];
  EXPECT_NEAR(mixed.value, 0.25 * full_sun_w_m2, 2.0 * mixed.half_width);
  EXPECT_LT(mixed.half_width, 0.01 * full_sun_w_m2);
  EXPECT_GT(mixed.half_width, 0.0);
  EXPECT_NEAR(result.organs[1].classes.sunlit_sd[0].value, 0.0, 1e-3 * full_sun_w_m2);
  // Area of 0.03 m2 in full light, and of 0.05 m2 in half of it.
  const double share = 0.03 / 0.08;
  const double expected_w_m2 = 0.5 * full_sun_w_m2 * std::sqrt(share * (1.0 - share));
  EXPECT_NEAR(result.leaf_classes.sunlit_sd[0].value, expected_w_m2, 2.0 * result.leaf_classes.sunlit_sd[0].half_width);
}

// Returns the deviation over all leaves of what their triangles absorb in a band, W m-2, as one run finds it, noise included.
double spread_of_triangles(const RadiationModel& model, const RadiationResult& result, std::size_t band) {
  double area = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const double element_m2 = area_m2(model.canopy.corners[e]);
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    double absorbed = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      absorbed += result.side_indirect_w_m2(2 * e + side, element_m2, band) *
                  (side == 0 ? optics.upper : optics.lower)[band].absorptance();
    }
    area += element_m2;
    sum += element_m2 * absorbed;
    squares += element_m2 * absorbed * absorbed;
  }
  return std::sqrt(squares / area - sum * sum / area / area);
}

TEST(ShadeClasses, KnowHowUnequalTheShadedAreaIs) {
  RadiationModel model = light_mix();
  model.sun.reset();
  for (Waveband& band : model.bands) band.direct_w_m2 = 0.0;
  const Prepared prepared(model);
  const auto run = [&](double packets) {
    return simulate(model, prepared, fixed_scatter(model, {.rays = 1.0, .packets = packets, .replicates = 16, .seed = 1}));
  };
  const RadiationResult truth = run(1e5);
  const RadiationResult coarse = run(100.0);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const double expected_w_m2 = spread_of_triangles(model, truth, b);
    const Estimate spread = coarse.leaf_classes.shaded_sd[b];
    EXPECT_NEAR(spread.value, expected_w_m2, 1.5 * spread.half_width);
    EXPECT_LT(spread.half_width, 0.75 * expected_w_m2);
    EXPECT_GT(spread_of_triangles(model, coarse, b), 1.05 * expected_w_m2) << "noise must matter here";
  }
}

TEST(ShadeClasses, WithoutABeamAllIsShaded) {
  RadiationModel model = light_mix();
  model.sun.reset();
  for (Waveband& band : model.bands) band.direct_w_m2 = 0.0;
  const RadiationResult result = simulate(model, to_a_wide_bound());
  EXPECT_EQ(result.leaf_classes.sunlit_m2.value, 0.0);
  EXPECT_TRUE(std::isnan(result.leaf_classes.absorbed_sunlit[0].value));
  EXPECT_GT(result.leaf_classes.absorbed_shaded[0].value, 0.0);
}

TEST(ShadeClasses, HaveHonestErrors) {
  const RadiationModel model = light_mix();
  const Prepared prepared(model);
  const auto run = [&](double rays, double packets, std::uint64_t seed) {
    return simulate(model, prepared, fixed_scatter(model, {.rays = rays, .packets = packets, .replicates = 12, .seed = seed}))
        .leaf_classes;
  };
  const ShadeClassResult truth = run(8e6, 2e5, 1000);
  constexpr int seeds = 100;
  int sunlit = 0, shaded = 0, sunlit_sd = 0, shaded_sd = 0;
  const auto covers = [](const Estimate& got, const Estimate& right) {
    return std::abs(got.value - right.value) <= std::hypot(got.half_width, right.half_width) ? 1 : 0;
  };
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const ShadeClassResult got = run(1e5, 2000, seed);
    sunlit += covers(got.absorbed_sunlit[1], truth.absorbed_sunlit[1]);
    shaded += covers(got.absorbed_shaded[1], truth.absorbed_shaded[1]);
    sunlit_sd += covers(got.sunlit_sd[1], truth.sunlit_sd[1]);
    shaded_sd += covers(got.shaded_sd[1], truth.shaded_sd[1]);
  }
  // A binomial count with probability 0.95 falls below 87 of 100 once in a thousand times.
  EXPECT_GE(sunlit, 87);
  EXPECT_GE(shaded, 87);
  EXPECT_GE(sunlit_sd, 87);
  EXPECT_GE(shaded_sd, 87);
}

TEST(RatioMean, ErrorsThatRiseAndFallTogetherCancel) {
  RandomStream random(3, 4);
  RatioMean together, apart;
  for (int k = 0; k < 50; ++k) {
    const double size = 1.0 + random.unit();
    together.add(3.0 * size, size, 1.0);
    apart.add(3.0 * (1.0 + random.unit()), size, 1.0);
  }
  EXPECT_NEAR(together.estimate(2.0, 0.0, 0.0).value, 3.0, 1e-12);
  EXPECT_LT(together.estimate(2.0, 0.0, 0.0).half_width, 1e-6);
  EXPECT_GT(apart.estimate(2.0, 0.0, 0.0).half_width, 0.1);
  EXPECT_TRUE(std::isnan(RatioMean().estimate(2.0, 0.0, 0.0).value));
}

// The beam's part is known, but of the other light half of the replicates saw nothing.
TEST(RatioMean, OfLightThatFewEventsBringHasAtLeastTheErrorOfUnseenOnes) {
  constexpr double unseen_other = 0.5;
  RatioMean seldom, often;
  for (int k = 0; k < 16; ++k) {
    seldom.add(2.0 + (k < 8 ? 0.01 : 0.0), 2.0, k < 8 ? 0.01 : 0.0);
    often.add(2.0 + (k < 9 ? 0.01 : 0.0), 2.0, k < 9 ? 0.01 : 0.0);
  }
  EXPECT_DOUBLE_EQ(seldom.estimate(2.0, 0.0, unseen_other).half_width, unseen_other / 2.0);
  EXPECT_LT(often.estimate(2.0, 0.0, unseen_other).half_width, 0.01);
}

TEST(SpreadMean, IsTheDeviationOfADensityOverAnArea) {
  SpreadMean equal, halves;
  RandomStream random(5, 6);
  for (int k = 0; k < 50; ++k) {
    const double area = 1.0 + 0.1 * random.unit();
    equal.add({area, 3.0 * area, 9.0 * area, 0.0});
    halves.add({area, 2.0 * area, 5.0 * area, 0.0});  // half of it with 1, half with 3
  }
  EXPECT_NEAR(equal.estimate(2.0).value, 0.0, 1e-6);
  EXPECT_LT(equal.estimate(2.0).half_width, 1e-4) << "the root of a rounding error";
  EXPECT_NEAR(halves.estimate(2.0).value, 1.0, 1e-12);
  EXPECT_LT(halves.estimate(2.0).half_width, 1e-6);
  EXPECT_TRUE(std::isnan(SpreadMean().estimate(2.0).value));
}

// A hundred places of equal area with densities from 1 to 3, of which every replicate finds estimates that are three times as
// wide.
TEST(SpreadMean, LeavesOutTheNoiseOfEstimates) {
  constexpr std::size_t places = 100;
  constexpr int runs = 400;
  const auto density = [](std::size_t place) { return 1.0 + 2.0 * (static_cast<double>(place) + 0.5) / places; };
  double variance = 0.0;
  for (std::size_t place = 0; place < places; ++place) variance += std::pow(density(place) - 2.0, 2) / places;
  RandomStream random(7, 8);
  int held = 0;
  double sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    SpreadMean spread;
    std::vector<double> earlier(places);
    for (int replicate = 0; replicate < 16; ++replicate) {
      SpreadMean::Sums sums{.area = 1.0};
      for (std::size_t place = 0; place < places; ++place) {
        const double estimate = density(place) + 6.0 * (random.unit() - 0.5);
        sums.density += estimate / places;
        sums.noisy_square += estimate * earlier[place] / places;
        earlier[place] += estimate;
      }
      spread.add(sums);
    }
    const Estimate estimate = spread.estimate(t_quantile(0.95, SpreadMean::effective(16)));
    sum += estimate.value * estimate.value / runs;
    held += std::abs(estimate.value - std::sqrt(variance)) <= estimate.half_width ? 1 : 0;
  }
  // The variance of a run's own mean, 3 / 1600, is part of it: 0.6 %; the noise alone is 9 times as large as the variance.
  EXPECT_NEAR(sum / variance, 1.0, 0.03);
  // A binomial count with probability 0.95 falls below 366 of 400 once in a thousand times.
  EXPECT_GE(held, 366);
}

}  // namespace
}  // namespace sunfleck::test

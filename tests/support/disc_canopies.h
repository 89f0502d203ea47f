#pragma once
// Homogeneous canopies of small flat leaves as in B11 of the validation table, where an explicit-disc ray tracer provides the
// reference. Averages over many random scenes and removes the scene noise by regression.

#include "programs/validate/known/canopy_scenes.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace sunfleck::test {

enum class CanopyLight { paper_sun, uniform_sky };

// A canopy of `count` regular polygons of equal area over 2 x 2 m, whose centres are distributed evenly between a disc's radius
// and 2 m above the ground.
struct DiscCanopy {
  double radius_m;  // radius of the disc with a leaf's area
  int count;
  bool horizontal;  // otherwise all orientations are equally likely
  int corners = 12;

  [[nodiscard]] double leaf_m2() const { return std::numbers::pi * radius_m * radius_m; }
  // Returns E[T_0] under the paper sun, exact for this number of leaves (A7).
  [[nodiscard]] double expected_beam_on_soil() const {
    const double shadow_m2 = leaf_m2() * (horizontal ? 1.0 : 0.5 / std::cos(radians(36.9824)));
    return std::pow(1.0 - shadow_m2 / 4.0, count);
  }
  // Returns the same under a uniform sky for leaves of all orientations, averaged over directions by the midpoint rule.
  [[nodiscard]] double expected_sky_on_soil() const {
    constexpr int steps = 100000;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double sine = std::sqrt((k + 0.5) / steps);  // sine of the elevation; its square is even over [0, 1)
      sum += std::pow(std::max(0.0, 1.0 - 0.5 * leaf_m2() / sine / 4.0), count);
    }
    return sum / steps;
  }
};
inline constexpr Plot disc_plot{2.0, 2.0, true};
inline Mesh disc_leaves(const DiscCanopy& canopy, std::uint32_t seed) {
  Random random(seed);
  MeshMaker maker;
  for (int leaf = 0; leaf < canopy.count; ++leaf) {
    const double x_m = random.uniform(0.0, 2.0);
    const double y_m = random.uniform(canopy.radius_m, 2.0);
    const double z_m = random.uniform(0.0, 2.0);
    const double inclination = canopy.horizontal ? 0.0 : std::acos(random.uniform(-1.0, 1.0));
    const glm::dvec3 normal = inclined(inclination, random.uniform(0.0, 2.0 * std::numbers::pi));
    maker.polygon({x_m, y_m, z_m}, normal, canopy.leaf_m2(), canopy.corners, random.uniform(0.0, 2.0 * std::numbers::pi));
  }
  return maker.mesh();
}

// Fluxes of each band, with standard errors in place of half-widths: reflected, on soil, and absorbed by leaves, over many
// random scenes. The regression removes the
// influence of each scene's own share of beam on soil.
struct CanopyFluxes {
  Estimate reflected, on_soil, leaves;
};
inline std::vector<CanopyFluxes> disc_canopy_fluxes(const DiscCanopy& canopy, int scenes, double rays, double packets,
                                                    CanopyLight light = CanopyLight::paper_sun) {
  const bool sky = light == CanopyLight::uniform_sky;
  const KnownMean empty(sky ? canopy.expected_sky_on_soil() : canopy.expected_beam_on_soil());
  std::vector<std::array<KnownMean, 3>> sums(2, {empty, empty, empty});
  for (int scene = 1; scene <= scenes; ++scene) {
    const auto seed = static_cast<std::uint32_t>(scene);
    RadiationModel model = paper_model(disc_leaves(canopy, seed), disc_plot, beijing_sun());
    if (sky) shine_from_sky(model, {});
    const ScatterWork work{.rays = rays, .packets = packets, .replicates = 8, .seed = seed, .bound = 0.003};
    const RadiationResult result = simulate(model, fixed_scatter(model, work));
    for (std::size_t b = 0; b < 2; ++b) {
      const double passed = sky ? sky_on_soil_w_m2(model, result, b) : result.ground_sunfleck_ratio.value;
      sums[b][0].add(passed, result.bands[b].reflected.value);
      sums[b][1].add(passed, result.layers[0].down[b].value);
      sums[b][2].add(passed, result.bands[b].absorbed_vegetation.value);
    }
  }
  std::vector<CanopyFluxes> fluxes;
  for (const auto& band : sums) fluxes.push_back({band[0].fit(), band[1].fit(), band[2].fit()});
  return fluxes;
}

// Extrapolates from two leaf sizes, the second half the first, to leaves of no size: the effect of finite leaves is nearly
// linear (B11).
inline CanopyFluxes without_leaf_size(const CanopyFluxes& large, const CanopyFluxes& half) {
  const auto flux = [](const Estimate& a, const Estimate& b) {
    return Estimate{2.0 * b.value - a.value, std::hypot(a.half_width, 2.0 * b.half_width)};
  };
  return {flux(large.reflected, half.reflected), flux(large.on_soil, half.on_soil), flux(large.leaves, half.leaves)};
}

struct CanopyRow {
  double reflected, on_soil, leaves;
};

// Checks a row by the rule of B11: 1 % on reflected flux, 0.002 on the rest, and errors small enough to make this a test.
inline void expect_row(const CanopyFluxes& got, const CanopyRow& expected, const char* what) {
  const auto expect_flux = [&](const Estimate& flux, double value, double tolerance, const char* name) {
    std::printf("%-24s %-10s expected %.5f got %.5f(%.1e), off by %+.5f of %.5f\n", what, name, value, flux.value,
                flux.half_width, flux.value - value, tolerance);
    EXPECT_LE(flux.half_width, 0.4 * tolerance) << what << ' ' << name;
    EXPECT_NEAR(flux.value, value, tolerance) << what << ' ' << name;
  };
  expect_flux(got.reflected, expected.reflected, 0.01 * expected.reflected, "reflected");
  expect_flux(got.on_soil, expected.on_soil, 0.002, "on soil");
  expect_flux(got.leaves, expected.leaves, 0.002, "leaves");
}

}  // namespace sunfleck::test

// Tests stands of spherical crowns from the radiation transfer model intercomparison (RAMI): C2 and C4 of the validation table.
// They have millions of triangles and take a minute or two each.
#include "support/comparison.h"
#include "support/leaf_scenes.h"

#include <gtest/gtest.h>

namespace sunfleck::test {
namespace {

constexpr int rami_replicates = 16;

glm::dvec3 any_direction(Random& random) {
  return inclined(std::acos(random.uniform(-1.0, 1.0)), random.uniform(0.0, 2.0 * std::numbers::pi));
}

glm::dvec3 in_sphere(Random& random, double radius_m) {
  return any_direction(random) * (radius_m * std::cbrt(random.uniform()));
}

// A crown with leaves of all orientations, evenly distributed in the sphere.
struct Crown {
  double radius_m;
  int leaves;
  double leaf_m2;
  int corners;  // corners of the leaf's polygon
};
void add_crown(MeshMaker& maker, const Crown& crown, const glm::dvec3& centre_m, Random& random) {
  for (int leaf = 0; leaf < crown.leaves; ++leaf) {
    const glm::dvec3 place_m = centre_m + in_sphere(random, crown.radius_m);
    const glm::dvec3 normal = any_direction(random);
    maker.polygon(place_m, normal, crown.leaf_m2, crown.corners, random.uniform(0.0, 2.0 * std::numbers::pi));
  }
}

struct Stand {
  Mesh mesh;
  Plot plot;
  SunPosition sun;
  LeafBand optics;
};
RadiationResult run(const Stand& stand, double rays, double packets) {
  RadiationModel model = leaf_model(stand.mesh, stand.plot, stand.sun, std::array{stand.optics});
  model.soil->patch_m = stand.plot.size_x_m / 100.0;
  const ScatterWork work{.rays = rays, .packets = packets, .replicates = rami_replicates, .bound = 0.001};
  RadiationResult result = simulate(model, fixed_scatter(model, work));
  EXPECT_EQ(result.lost_rays, 0U);
  EXPECT_EQ(result.bands[0].ledger.residual(), 0);
  std::printf("%zu triangles, leaf area index %.4f, beam on soil %.5f, %.0f s\n", model.canopy.size(), result.leaf_area_index,
              result.ground_sunfleck_ratio.value, result.direct.seconds + result.indirect.seconds);
  return result;
}

void expect_near(const Estimate& got, double expected, double tolerance, const char* what) {
  const double error = standard_error(got, rami_replicates);
  std::printf("%-28s expected %.5f got %.5f(%.1e), off by %+.5f of %.5f\n", what, expected, got.value, error,
              got.value - expected, tolerance);
  EXPECT_LE(error, tolerance / 4.0) << what;
  EXPECT_NEAR(got.value, expected, tolerance) << what;
}

// HET01 discrete, NIR, sun at 20 degrees from the zenith. Here the disc of radius 0.1 m is a square of equal area, and the
// leaves are drawn again, which changes the reflected flux by up to 1.2 % and the other fluxes by up to 0.004 (C2).
TEST(Rami, FloatingSpheres) {
  const std::array<glm::dvec3, 15> centres_enu_m = {{{-24.8302, 11.6110, 15.6210},
                                                     {-38.3380, -9.06342, 17.6094},
                                                     {-31.3562, 32.5297, 14.3051},
                                                     {11.9126, 8.32062, 12.1220},
                                                     {39.4855, 37.1247, 16.3647},
                                                     {-8.30999, -4.39422, 14.4241},
                                                     {12.2769, -25.1402, 12.4492},
                                                     {32.4756, -26.9023, 16.3684},
                                                     {-7.46991, -32.2138, 12.6678},
                                                     {-27.4794, -32.0266, 15.9146},
                                                     {33.5709, -6.31039, 14.5332},
                                                     {-5.24326, 39.8405, 16.8247},
                                                     {18.1699, 35.8223, 11.5683},
                                                     {-5.26569, 18.9618, 17.2535},
                                                     {37.8226, 14.6769, 11.5936}}};
  Stand stand{{}, {100.0, 100.0, true}, sun_at(70.0, 90.0), {"NIR", 0.4957, 0.4409, 0.159}};
  Random random(1);
  MeshMaker maker;
  const Crown crown{10.0, 49'999, std::numbers::pi * 0.01, 4};
  for (const glm::dvec3& centre : centres_enu_m)
    add_crown(maker, crown, from_east_north_up(centre.x, centre.y, centre.z), random);
  stand.mesh = maker.mesh();
  const RadiationResult result = run(stand, 4e6, 60'000);
  expect_near(result.bands[0].reflected, 0.28852, 0.012 * 0.28852, "HET01 reflected");
  expect_near(result.bands[0].absorbed_vegetation, 0.10323, 0.004, "HET01 absorbed by leaves");
  expect_near(result.layers[0].down[0], 0.72326, 0.004, "HET01 on soil");
}

// Returns the centres of crowns of 5 m radius that do not touch, 7 to 11 m high, at random in a plot of `size_m`.
std::vector<glm::dvec3> crown_centres(double size_m, int count, Random& random) {
  std::vector<glm::dvec3> centres_m;
  while (centres_m.size() < static_cast<std::size_t>(count)) {
    const glm::dvec3 tried_m(random.uniform(0.0, size_m), random.uniform(7.0, 11.0), random.uniform(0.0, size_m));
    const auto touches = [&](const glm::dvec3& other_m) {
      glm::dvec3 apart_m = tried_m - other_m;
      apart_m.x -= size_m * std::round(apart_m.x / size_m);
      apart_m.z -= size_m * std::round(apart_m.z / size_m);
      return glm::length(apart_m) < 10.0;
    };
    if (std::none_of(centres_m.begin(), centres_m.end(), touches)) centres_m.push_back(tried_m);
  }
  return centres_m;
}

// RAMI4PILPS open forest canopy, visible, leaf area index 1.50 over medium soil, sun at 27.46 degrees from the zenith: the mean
// of stands with other crown positions. A leaf is a triangle of 0.06 m2, a fortieth of the crown across.
TEST(Rami, OpenForestCanopy) {
  constexpr int stands = 3;
  constexpr double size_m = 200.0;
  constexpr int crowns = 153;  // a crown cover of 0.30041
  const Crown crown{5.0, static_cast<int>(5.0 * std::numbers::pi * 25.0 / 0.06), 0.06, 3};
  ReplicateMean reflected, leaves, on_soil;
  for (int k = 1; k <= stands; ++k) {
    Random random(static_cast<std::uint32_t>(k));
    MeshMaker maker;
    for (const glm::dvec3& centre_m : crown_centres(size_m, crowns, random)) add_crown(maker, crown, centre_m, random);
    const Stand stand{maker.mesh(), {size_m, size_m, true}, sun_at(90.0 - 27.46, 90.0), {"VIS", 0.0735, 0.0566, 0.1217}};
    const RadiationResult result = run(stand, 4e6, 20'000);
    reflected.add(result.bands[0].reflected.value);
    leaves.add(result.bands[0].absorbed_vegetation.value);
    on_soil.add(result.layers[0].down[0].value);
  }
  const auto expect_mean = [](const ReplicateMean& mean, double expected, double tolerance, const char* what) {
    std::printf("%-28s expected %.6f got %.5f(%.1e), off by %+.5f of %.5f\n", what, expected, mean.mean(),
                mean.standard_error(), mean.mean() - expected, tolerance);
    EXPECT_NEAR(mean.mean(), expected, tolerance) << what;
  };
  expect_mean(reflected, 0.061951, 0.02 * 0.061951, "1.50 MED 27 reflected");
  expect_mean(leaves, 0.314038, 0.006, "1.50 MED 27 leaves");
  expect_mean(on_soil, 0.710476, 0.006, "1.50 MED 27 on soil");
}

}  // namespace
}  // namespace sunfleck::test

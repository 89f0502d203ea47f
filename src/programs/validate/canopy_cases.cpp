#include "programs/validate/canopy_cases.h"

#include "base/random.h"
#include "programs/validate/known/canopy_scenes.h"
#include "programs/validate/known/case_scenes.h"
#include "programs/validate/known/known_formulas.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sunfleck {
namespace {

using std::numbers::pi;
constexpr int scenes = 16;

enum class LeafAngles { spherical, horizontal, vertical };

double inclination_rad(LeafAngles angles, RandomStream& random) {
  if (angles == LeafAngles::horizontal) return 0.0;
  if (angles == LeafAngles::vertical) return 0.5 * pi;
  return std::acos(random.unit());
}

// Uses exponential waiting times (Knuth 1969, The Art of Computer Programming 2, 3.4.1).
int poisson(double mean, RandomStream& random) {
  int count = -1;
  for (double sum = 0.0; sum < mean; ++count) sum -= std::log(1.0 - random.unit());
  return count;
}

// Builds square leaves over a square plot, with centres uniformly distributed from `low_m` to `high_m` above the ground.
Mesh scattered_leaves(int count, double leaf_m2, double plot_m, double low_m, double high_m, LeafAngles angles,
                      RandomStream& random) {
  MeshMaker mesh;
  for (int leaf = 0; leaf < count; ++leaf) {
    const double x_m = plot_m * random.unit();
    const double y_m = low_m + (high_m - low_m) * random.unit();
    const double z_m = plot_m * random.unit();
    const glm::dvec3 normal = inclined(inclination_rad(angles, random), 2.0 * pi * random.unit());
    mesh.polygon({x_m, y_m, z_m}, normal, leaf_m2, 4, 2.0 * pi * random.unit());
  }
  return mesh.mesh();
}

// Converts an estimate whose half-width is a standard error with `replicates` - 1 degrees of freedom.
Estimate with_half_width(const Estimate& estimate, std::size_t replicates) {
  return {estimate.value, estimate.half_width * t_quantile(Ask{}.confidence, replicates)};
}

struct LevelCase {
  LeafBand band;
  const char* what;
};
constexpr std::array level_cases = {LevelCase{par_band, "PAR"}, LevelCase{nir_band, "NIR"},
                                    LevelCase{{"white", 0.5, 0.5, 0.0}, "leaves that absorb nothing"},
                                    LevelCase{{"through", 0.0, 0.3, 0.0}, "leaves that only transmit"}};

// Horizontal leaves in a tall canopy. Leaves of finite size affect reflectance, because light that came through a gap leaves
// through the same gap; the effect is nearly linear in their size relative to the canopy's height. Explicit leaves of 1 % of
// the height reflect 0.0015 more in PAR and 0.0025 more in NIR than infinitely small ones.
constexpr double level_leaf_m2 = 0.0016, level_height_m = 20.0, level_index = 3.0;
constexpr double finite_leaves = 4e-4;

}  // namespace

// If the number of leaves is drawn from a Poisson distribution, exp(-K L) is the exact expectation, where K = G / cos Z is the
// leaves' mean projection on the ground along the beam; their sunlit area per ground area is (1 - exp(-K L)) / K.
void random_leaf_cases(CaseBench& bench) {
  struct Row {
    const char* what;
    LeafAngles angles;
    double extinction, index;  // for the sun of Beijing: G = 1/2, cos Z, 2/pi sin Z
  };
  const double zenith_rad = 0.5 * pi - beijing_sun().elevation_rad;
  constexpr double leaf_m2 = 0.0025, plot_m = 2.0, height_m = 5.0;
  std::uint64_t seed = 1;
  for (const Row& row :
       {Row{"spherical leaves, leaf area index 0.5", LeafAngles::spherical, 0.5 / std::cos(zenith_rad), 0.5},
        Row{"spherical leaves, leaf area index 3", LeafAngles::spherical, 0.5 / std::cos(zenith_rad), 3.0},
        Row{"level leaves, leaf area index 1", LeafAngles::horizontal, 1.0, 1.0},
        Row{"upright leaves, leaf area index 1", LeafAngles::vertical, 2.0 / pi * std::tan(zenith_rad), 1.0}}) {
    ReplicateMean passed, sunlit;
    for (int scene = 0; scene < scenes; ++scene, ++seed) {
      RandomStream random(seed, 0);
      const int count = poisson(row.index * plot_m * plot_m / leaf_m2, random);
      const Mesh mesh = scattered_leaves(count, leaf_m2, plot_m, 0.1, 0.1 + height_m, row.angles, random);
      const RadiationModel model = black_model(mesh, {plot_m, plot_m, true}, beijing_sun());
      SolveSettings settings = case_work(model, 65536, 0.0, 8);
      settings.seed = seed;
      const RadiationResult result = bench.simulate(model, settings);
      passed.add(result.bands[0].absorbed_soil.value);
      sunlit.add(result.sunlit_leaf_fraction.value * result.leaf_area_index);
    }
    const double expected = std::exp(-row.extinction * row.index);
    const double quantile = t_quantile(Ask{}.confidence, scenes);
    bench.compare(fmt::format("{}, beam on soil", row.what), passed.estimate(quantile), expected,
                  {.replicates = scenes, .largest_error = 0.006});
    bench.compare(fmt::format("{}, sunlit leaf area", row.what), sunlit.estimate(quantile), (1.0 - expected) / row.extinction,
                  {.replicates = scenes, .largest_error = 0.02});
  }
}

void two_stream_cases(CaseBench& bench) {
  std::vector<LeafBand> bands;
  for (const LevelCase& each : level_cases) bands.push_back(each.band);
  // The beam passes `count` leaves with probability (1 - leaf area)^count, here exp(-level_index) to within half a leaf.
  const int count = static_cast<int>(std::lround(-level_index / std::log1p(-level_leaf_m2)));
  const KnownMean empty(std::exp(count * std::log1p(-level_leaf_m2)));
  std::vector<std::array<KnownMean, 3>> fluxes(bands.size(), {empty, empty, empty});
  double reflected_without_reflectance = 0.0;
  for (std::uint64_t scene = 1; scene <= scenes; ++scene) {
    RandomStream random(scene, 1);
    const Mesh mesh = scattered_leaves(count, level_leaf_m2, 1.0, 0.1, 0.1 + level_height_m, LeafAngles::horizontal, random);
    const RadiationModel model = leaf_model(mesh, {1.0, 1.0, true}, beijing_sun(), bands);
    SolveSettings settings = case_work(model, 8 * 8192, 2048, 8);
    settings.seed = scene;
    settings.accuracy.indirect = 1e-4;
    const RadiationResult result = bench.simulate(model, settings);
    const double passed = result.ground_sunfleck_ratio.value;
    for (std::size_t b = 0; b < bands.size(); ++b) {
      fluxes[b][0].add(passed, result.bands[b].reflected.value);
      fluxes[b][1].add(passed, result.layers[0].down[b].value);
      fluxes[b][2].add(passed, result.bands[b].absorbed_vegetation.value);
    }
    reflected_without_reflectance += static_cast<double>(result.bands[3].ledger.reflected);
  }
  constexpr std::size_t degrees = scenes - 1;  // mean and slope are fitted
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const LeafBand& band = bands[b];
    const LevelCanopyLight light =
        light_in_level_canopy(level_index, {band.reflectance, band.transmittance}, band.soil_reflectance);
    const Ask ask{.replicates = degrees, .largest_error = 1.5e-3, .tolerance = finite_leaves};
    const auto compare = [&](const char* what, const KnownMean& flux, double expected) {
      bench.compare(fmt::format("level leaves, {}, {}", level_cases[b].what, what), with_half_width(flux.fit(), degrees),
                    expected, ask);
    };
    if (band.reflectance > 0.0) compare("reflected", fluxes[b][0], light.reflected);
    compare("on soil", fluxes[b][1], light.on_soil);
    if (b < 2) compare("absorbed by leaves", fluxes[b][2], light.leaves);
  }
  bench.equal("level leaves that only transmit, quanta reflected", reflected_without_reflectance, 0.0, 0.0);
}

namespace {

struct TracedFlux {
  double value, error;
};

}  // namespace

// Reference values with their own standard errors from an independent double-precision ray tracer with a uniform grid and
// analog weights, 2e7 to 6e7 paths.
void explicit_scene_cases(CaseBench& bench) {
  struct Row {
    const char* name;
    TracedFlux reflected, leaves, on_soil;
  };
  const auto compare = [&](const RadiationResult& result, std::size_t b, const Row& row) {
    const auto flux = [&](const char* what, const Estimate& got, const TracedFlux& reference) {
      bench.compare(fmt::format("{}, {}", row.name, what), got, reference.value,
                    {.largest_error = 5e-4, .reference_error = reference.error});
    };
    flux("reflected", result.bands[b].reflected, row.reflected);
    flux("absorbed by leaves", result.bands[b].absorbed_vegetation, row.leaves);
    flux("on soil", result.layers[0].down[b], row.on_soil);
  };
  const RadiationModel beam = leaf_model(explicit_leaves(), {1.0, 1.0, true}, beijing_sun(), std::array{par_band, nir_band});
  const RadiationResult of_beam = bench.simulate(beam, case_work(beam, 1e6, 16384));
  compare(of_beam, 0, {"PAR beam", {0.051649, 9e-6}, {0.788413, 4e-5}, {0.188160, 4e-5}});
  compare(of_beam, 1, {"NIR beam", {0.405730, 9e-5}, {0.241976, 3e-5}, {0.440377, 1.1e-4}});
  bench.compare("beam on soil at its first hit", of_beam.ground_sunfleck_ratio, 0.172756,
                {.largest_error = 2e-4, .reference_error = 5e-5});
  RadiationModel sky = leaf_model(explicit_leaves(), {1.0, 1.0, true}, beijing_sun(), std::array{par_band});
  shine_from_sky(sky, {.kind = SkyKind::uniform});
  compare(bench.simulate(sky, case_work(sky, 1.0, 32768)), 0,
          {"PAR uniform sky", {0.053482, 2e-5}, {0.837763, 5e-5}, {0.127951, 6e-5}});
}

}  // namespace sunfleck

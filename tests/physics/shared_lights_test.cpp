// Compares lights that share their packets with separate runs of each light, and tests the errors of their sums.

#include "physics/canopy/maize_plant.h"
#include "support/leaf_scenes.h"
#include "support/maize_stands.h"
#include "support/scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

constexpr int lights = 24;
constexpr int replicates = 32;

enum class Source { sun, sky, both };

// Returns the model in the light of moments spread over a clear day, from a low sun to a low sun, each brighter towards noon.
std::vector<RadiationModel> day_of(const RadiationModel& model, Source source, int count = lights) {
  std::vector<RadiationModel> moments(static_cast<std::size_t>(count), model);
  for (int k = 0; k < count; ++k) {
    const double hour = (k + 0.5) / count;  // of the daytime
    RadiationModel& moment = moments[static_cast<std::size_t>(k)];
    const double elevation_deg = 6.0 + 60.0 * std::sin(std::numbers::pi * hour);
    moment.sun = sun_at(elevation_deg, 80.0 + 200.0 * hour);
    if (source != Source::sun) moment.sky = SkyModel{.kind = SkyKind::general};
    for (std::size_t b = 0; b < moment.bands.size(); ++b) {
      const double sine = std::sin(moment.sun->elevation_rad);
      moment.bands[b].direct_w_m2 = source == Source::sky ? 0.0 : 400.0 * sine * (1.0 + 0.2 * static_cast<double>(b));
      moment.bands[b].diffuse_w_m2 = source == Source::sun ? 0.0 : 30.0 + 50.0 * sine;
    }
  }
  return moments;
}

// Two results of a light from independent random numbers, figure by figure.
class Comparison {
 public:
  void add(const RadiationResult& a, const RadiationResult& b) {
    for (std::size_t band = 0; band < a.bands.size(); ++band) {
      const BandResult &x = a.bands[band], &y = b.bands[band];
      EXPECT_EQ(x.ledger.residual(), 0) << x.name;
      const double scale = x.incident.value;
      add(x.absorbed_vegetation, y.absorbed_vegetation, x.unshot + y.unshot, scale);
      add(x.absorbed_soil, y.absorbed_soil, x.unshot + y.unshot, scale);
      add(x.reflected, y.reflected, x.unshot + y.unshot, scale);
      for (std::size_t k = 0; k < a.layers.size(); ++k) {
        add(a.layers[k].down[band], b.layers[k].down[band], 0.0, scale);
        add(a.layers[k].up[band], b.layers[k].up[band], 0.0, scale);
        if (k + 1 < a.layers.size()) add(a.layers[k].absorbed[band], b.layers[k].absorbed[band], 0.0, scale);
      }
      for (std::size_t o = 0; o < a.organs.size(); ++o) {
        add(a.organs[o].indirect[band], b.organs[o].indirect[band], 0.0, scale);
        add(a.organs[o].absorbed[band], b.organs[o].absorbed[band], 0.0, scale);
      }
    }
  }

  // Expects the differences to be as large as their errors say, and none to be larger than chance allows in such a table.
  void expect_plausible(const std::string& what) const {
    const double rms = std::sqrt(squares_ / static_cast<double>(count_));
    std::printf("%s: %zu comparisons, rms z %.3f, largest %.2f\n", what.c_str(), count_, rms, largest_);
    EXPECT_GE(rms, 0.9) << what;
    EXPECT_LE(rms, 1.1) << what;
    EXPECT_LE(largest_, table_quantile(count_, replicates)) << what;
  }

 private:
  void add(const Estimate& a, const Estimate& b, double unshot, double scale) {
    const double error = std::hypot(a.half_width - 0.5 * unshot, b.half_width - 0.5 * unshot) / t_quantile(0.95, replicates);
    if (!(error > 1e-9 * scale)) return;  // known without chance
    const double z = (a.value - b.value) / error;
    squares_ += z * z;
    largest_ = std::max(largest_, std::abs(z));
    ++count_;
  }

  std::size_t count_ = 0;
  double squares_ = 0.0, largest_ = 0.0;
};

std::vector<RadiationResult> simulate_together(const std::vector<RadiationModel>& moments, const Prepared& prepared,
                                               const SolveSettings& settings, const WantedSums& sums = {},
                                               std::vector<JointErrors>* errors = nullptr) {
  CpuTracer tracer(prepared.bvh, tracer_scene(moments.front()));
  std::vector<RadiationResult> results(moments.size());
  const SharedOutcome outcome = solve_lights(
      moments, prepared.layout, tracer, settings, {}, nullptr, sums,
      [&](std::size_t light, RadiationResult result, const SharedOutcome&) { results[light] = std::move(result); });
  if (errors != nullptr) *errors = outcome.sum_errors;
  return results;
}

void compare_with_separate_runs(const RadiationModel& model, Source source, double packets, const std::string& what) {
  const std::vector<RadiationModel> moments = day_of(model, source);
  const Prepared prepared(moments.front());
  const ScatterWork work{.rays = 2e5, .packets = packets, .replicates = replicates, .seed = 9, .bound = 1e-3};
  const std::vector<RadiationResult> together = simulate_together(moments, prepared, fixed_scatter(model, work));
  Comparison comparison;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    ScatterWork own = work;
    own.seed = 1000 + k;
    comparison.add(together[k], simulate(moments[k], prepared, fixed_scatter(moments[k], own)));
  }
  comparison.expect_plausible(what);
}

struct SharedScene {
  const char* name;
  std::function<RadiationModel()> make;
  // Scaling each column to its exact total is a ratio estimate, whose bias falls as 1 / packets. It is far below the error in
  // runs to a bound, but not with a few hundred landings shared by the 24 beams of a scene whose organs lie deep in the shade.
  double packets = 2000;
};

void PrintTo(const SharedScene& scene, std::ostream* out) {
  *out << scene.name;
}

RadiationModel small_leaves() {
  return paper_model(random_leaves(60, 0.01, unit_plot, 0.6, 5), unit_plot, beijing_sun());
}

// Level leaves of 10 cm, whose sunflecks are smaller than they are.
RadiationModel flat_leaves() {
  Random random(3);
  MeshMaker maker;
  for (int leaf = 1; leaf <= 120; ++leaf) {
    maker.organ("leaf", 1, leaf);
    const double x_m = random.uniform(0.0, 0.9), z_m = random.uniform(0.0, 0.9);
    maker.level(x_m, x_m + 0.1, z_m, z_m + 0.1, random.uniform(0.05, 0.8));
  }
  return paper_model(maker.mesh(), unit_plot, beijing_sun());
}

RadiationModel isolated_plant() {
  const Plot plot{1.0, 1.0, false};
  return paper_model(random_leaves(40, 0.01, {0.6, 0.6, false}, 0.7, 9), plot, beijing_sun());
}

// A plant so small on its floor that light is aimed at it.
RadiationModel plant_on_a_wide_floor() {
  const Plot plot{6.0, 6.0, false};
  return paper_model(random_leaves(40, 0.004, {0.4, 0.4, false}, 0.3, 9), plot, beijing_sun());
}

RadiationModel maize(double spacing_in_row_m) {
  const MaizeStand stand{.rows = 1, .per_row = 1, .spacing_in_row_m = spacing_in_row_m};
  MaizeDetail coarse;
  coarse.blade_step_m *= 2.0;
  const glm::dvec2 size_m = plot_size_m(stand);
  return paper_model(make_maize(stand, coarse), {size_m.x, size_m.y, true}, beijing_sun());
}

class SharedLights : public testing::TestWithParam<SharedScene> {};

TEST_P(SharedLights, AgreeWithSeparateRunsUnderTheSun) {
  compare_with_separate_runs(GetParam().make(), Source::sun, GetParam().packets, std::string(GetParam().name) + ", sun");
}

TEST_P(SharedLights, AgreeWithSeparateRunsUnderTheSky) {
  compare_with_separate_runs(GetParam().make(), Source::sky, GetParam().packets, std::string(GetParam().name) + ", sky");
}

TEST_P(SharedLights, AgreeWithSeparateRunsUnderBoth) {
  compare_with_separate_runs(GetParam().make(), Source::both, GetParam().packets, std::string(GetParam().name) + ", both");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedLights,
                         testing::Values(SharedScene{"SmallLeaves", small_leaves}, SharedScene{"FlatLeaves", flat_leaves},
                                         SharedScene{"IsolatedPlant", isolated_plant},
                                         SharedScene{"PlantOnAWideFloor", plant_on_a_wide_floor},
                                         SharedScene{"SparseMaize", [] { return maize(0.6); }, 20000},
                                         SharedScene{"DenseMaize", [] { return maize(0.3); }, 20000}),
                         [](const auto& scene) { return std::string(scene.param.name); });

// The error of a sum over lights is that of the sums of the replicates: over many seeds, intervals of 95 % hold the true sum.
TEST(SharedLightSums, HaveErrorsThatIncludeTheirCorrelation) {
  constexpr int seeds = 60;
  const RadiationModel model = small_leaves();
  const std::vector<RadiationModel> moments = day_of(model, Source::both, 6);
  const Prepared prepared(moments.front());
  // The leaves are one group.
  WantedSums sums{{LightSum()}, std::vector<std::size_t>(model.canopy.organs.size(), 0)};
  for (std::size_t k = 0; k < moments.size(); ++k) sums.of_lights[0].push_back({k, 600.0});
  const ScatterWork work{.rays = 6e4, .packets = 1000, .replicates = 16, .seed = 1, .bound = 1e-3};
  ReplicateMean vegetation;  // of the sums of all seeds
  double squares = 0.0;      // of the errors that they state
  double independent = 0.0;  // of the errors that independent lights would have
  for (int seed = 1; seed <= seeds; ++seed) {
    SolveSettings settings = fixed_scatter(model, work);
    settings.seed = static_cast<std::uint64_t>(seed);
    std::vector<JointErrors> errors;
    const std::vector<RadiationResult> results = simulate_together(moments, prepared, settings, sums, &errors);
    double total = 0.0;
    for (const RadiationResult& result : results) {
      const BandResult& nir = result.bands[1];
      total += 600.0 * nir.absorbed_vegetation.value;
      independent += std::pow(600.0 * (nir.absorbed_vegetation.half_width - nir.unshot), 2);
    }
    vegetation.add(total);
    const double error = errors.at(0).bands.at(1).vegetation;
    squares += std::pow(error, 2);
    // The totals are those of split quanta, with coefficients rounded to 2^-32; the groups' are landed quanta times the
    // absorptance.
    EXPECT_NEAR(errors.at(0).groups.at(1), error, 1e-8 * error);
  }
  const double stated = std::sqrt(squares / seeds) / t_quantile(0.95, 16);
  const double real = vegetation.standard_error() * std::sqrt(static_cast<double>(seeds));
  std::printf("error of the sum: real %.4g, stated %.4g, of independent lights %.4g\n", real, stated,
              std::sqrt(independent / seeds) / t_quantile(0.95, 16));
  // The standard deviation of 60 values is uncertain by 9 %; three times that are allowed.
  EXPECT_NEAR(stated / real, 1.0, 0.28);
}

// A packet that starts where only one of the two lights shines may carry twice the part of that light's flux that it would carry
// alone, so that what nothing reached in either light may have missed twice as much.
TEST(SharedLightErrors, OfWhatNothingReachesAllowForPacketsOfOneLight) {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.2, 0.8, 0.2, 0.8, 0.5);
  maker.organ("leaf", 1, 2);
  maker.level(0.4, 0.6, 0.4, 0.6, 0.2);  // in the shade of the upper leaf, which transmits nothing
  RadiationModel model = paper_model(maker.mesh(), unit_plot, sun_at(90.0, 0.0));
  for (SurfaceOptics& optics : model.optics) {
    for (FaceOptics& face : optics.upper) face.transmittance = 0.0;
  }
  model.soil.reset();
  const Prepared prepared(model);
  const SolveSettings settings = fixed_scatter(model, {.rays = 2e4, .packets = 500, .replicates = 8});
  const Estimate alone = simulate(model, prepared, settings).organs.at(1).indirect.at(0);
  const Estimate together = simulate_together({model, model}, prepared, settings).at(1).organs.at(1).indirect.at(0);
  EXPECT_EQ(alone.value, 0.0);
  EXPECT_EQ(together.value, 0.0);
  EXPECT_GT(alone.half_width, 0.0);
  EXPECT_NEAR(together.half_width, 2.0 * alone.half_width, 0.01 * alone.half_width);
}

// All lights keep their books, and one light alone is simulated as ever.
TEST(SharedLightBooks, CloseInEveryColumn) {
  const std::vector<RadiationModel> moments = day_of(flat_leaves(), Source::both, 5);
  const Prepared prepared(moments.front());
  const SolveSettings settings = fixed_scatter(moments.front(), {.rays = 2e4, .packets = 500, .replicates = 8});
  for (const RadiationResult& result : simulate_together(moments, prepared, settings)) {
    for (const BandResult& band : result.bands) {
      EXPECT_EQ(band.ledger.residual(), 0);
      EXPECT_GT(band.ledger.absorbed_vegetation, 0);
    }
    EXPECT_EQ(result.lost_rays, 0U);
  }
  const std::vector<RadiationResult> alone = simulate_together({moments[2]}, prepared, settings);
  const RadiationResult expected = simulate(moments[2], prepared, settings);
  EXPECT_EQ(alone[0].side_indirect, expected.side_indirect);
  EXPECT_EQ(alone[0].bands[1].ledger.absorbed_soil, expected.bands[1].ledger.absorbed_soil);
}

}  // namespace
}  // namespace sunfleck::test

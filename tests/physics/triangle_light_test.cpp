// The light of single triangles: exact in its sums, honest in its errors, and fit for what is computed from it.

#include "devices/tracers/cpu_tracer.h"
#include "physics/canopy/maize_plant.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/solve/work_planner.h"
#include "support/leaf_scenes.h"
#include "support/maize_stands.h"
#include "support/result_numbers.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <thread>
#include <vector>

namespace sunfleck::test {
namespace {

// Returns a maize plant in a stand without end, of a resolution that keeps the test quick.
RadiationModel maize(double spacing_in_row_m, bool overcast) {
  const MaizeStand stand{.rows = 1, .per_row = 1, .spacing_in_row_m = spacing_in_row_m};
  MaizeDetail coarse;
  coarse.blade_step_m *= 1.5;
  const glm::dvec2 size_m = plot_size_m(stand);
  RadiationModel model = leaf_model(make_maize(stand, coarse), {size_m.x, size_m.y, true}, beijing_sun(), std::array{par_band});
  model.bands[0].direct_w_m2 = overcast ? 0.0 : 350.0;
  if (overcast) {
    model.sky = SkyModel{.kind = SkyKind::overcast};
    model.bands[0].diffuse_w_m2 = 150.0;
  }
  return model;
}

// Work in beam rays per triangle; as many packets are drawn. On the sparse plot of 186,000 triangles a run to --error 0.05 traces
// 0.3, one to 0.02 traces 0.9, and one to the default bounds 17 of each.
constexpr double to_five_percent = 0.3, to_two_percent = 0.9, to_default = 17.0, to_the_truth = 150.0;

SolveSettings with_work(const RadiationModel& model, double rays_per_triangle, std::uint64_t seed) {
  const double rays = rays_per_triangle * static_cast<double>(model.canopy.size());
  constexpr int replicate_count = 16;
  // A packet lands some three times before it is retired, so that a third as many start.
  SolveSettings settings = fixed_scatter(
      model,
      {.rays = rays, .packets = rays / 3.0 / replicate_count, .replicates = replicate_count, .seed = seed, .bound = 0.01});
  settings.element_errors = ElementErrors::refine;
  return settings;
}

// A property of each triangle of the vegetation, with its area.
struct Leaves {
  std::vector<double> area_m2, absorbed_w_m2, error_w_m2;
  std::vector<std::uint64_t> landings;
};

Leaves leaves_of_run(const RadiationModel& model, const RadiationResult& result) {
  const Surfaces surfaces(model);
  Leaves leaves;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    if (surfaces.at(e).role != Role::leaf) continue;
    const double area = area_m2(model.canopy.corners[e]);
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    double absorbed = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      const double incident = result.side_direct_w_m2(2 * e + side, area, model.bands[0].direct_w_m2) +
                              result.side_indirect_w_m2(2 * e + side, area, 0);
      absorbed += incident * (side == 0 ? optics.upper : optics.lower)[0].absorptance();
    }
    leaves.area_m2.push_back(area);
    leaves.absorbed_w_m2.push_back(absorbed);
    leaves.error_w_m2.push_back(result.element_error.empty() ? no_value : result.element_error[e]);
    leaves.landings.push_back(result.elements[e].both());
  }
  return leaves;
}

// Returns the photosynthesis of the leaves by a light curve that saturates at half of full sun: P = A / (A + 150 W m-2).
double photosynthesis(const Leaves& leaves) {
  double sum = 0.0;
  for (std::size_t k = 0; k < leaves.area_m2.size(); ++k) {
    sum += leaves.area_m2[k] * leaves.absorbed_w_m2[k] / (leaves.absorbed_w_m2[k] + 150.0);
  }
  return sum;
}

// Returns the root-mean-square difference, weighted by area and relative to the mean.
double difference(const Leaves& a, const Leaves& b) {
  double squares = 0.0, sum = 0.0, area = 0.0;
  for (std::size_t k = 0; k < a.area_m2.size(); ++k) {
    const double off = a.absorbed_w_m2[k] - b.absorbed_w_m2[k];
    squares += a.area_m2[k] * off * off;
    sum += a.area_m2[k] * b.absorbed_w_m2[k];
    area += a.area_m2[k];
  }
  return std::sqrt(squares * area) / sum;
}

// Counts the area whose interval holds the truth, among the triangles that `counts` selects.
template <class Counts>
double covered(const Leaves& run, const Leaves& truth, const Counts& counts) {
  double hit = 0.0, area = 0.0;
  for (std::size_t k = 0; k < run.area_m2.size(); ++k) {
    if (!counts(k)) continue;
    area += run.area_m2[k];
    const double error = std::hypot(run.error_w_m2[k], truth.error_w_m2[k]);
    if (std::abs(run.absorbed_w_m2[k] - truth.absorbed_w_m2[k]) <= error) hit += run.area_m2[k];
  }
  return hit / area;
}

class TriangleLight : public testing::TestWithParam<std::pair<double, bool>> {
 protected:
  [[nodiscard]] RadiationResult run(double work, std::uint64_t seed, ElementErrors errors = ElementErrors::refine) const {
    SolveSettings settings = with_work(model_, work, seed);
    settings.element_errors = errors;
    return simulate(model_, prepared_, settings);
  }
  [[nodiscard]] Leaves leaves(double work, std::uint64_t seed, ElementErrors errors = ElementErrors::refine) const {
    return leaves_of_run(model_, run(work, seed, errors));
  }

  RadiationModel model_ = maize(GetParam().first, GetParam().second);
  Prepared prepared_{model_};
};

INSTANTIATE_TEST_SUITE_P(Maize, TriangleLight,
                         testing::Values(std::pair{0.6, false}, std::pair{0.3, false}, std::pair{0.3, true}),
                         [](const auto& stand) {
                           return std::string(stand.param.first > 0.5 ? "Sparse" : "Dense") +
                                  (stand.param.second ? "Overcast" : "InTheSun");
                         });

TEST_P(TriangleLight, ServesALightCurve) {
  const double truth = photosynthesis(leaves(to_the_truth, 99));
  for (const std::uint64_t seed : {1, 2}) {
    EXPECT_NEAR(photosynthesis(leaves(to_two_percent, seed)) / truth, 1.0, 0.015);
    EXPECT_NEAR(photosynthesis(leaves(to_five_percent, seed)) / truth, 1.0, 0.04);
  }
  // Light counted triangle by triangle is biased by its noise.
  EXPECT_LT(photosynthesis(leaves(to_five_percent, 1, ElementErrors::skip)) / truth, 0.85);
}

// Light is all or nothing at a point, so that half of a half-lit triangle does photosynthesis in full light. The sum is linear
// in the share of each triangle that is lit, and noise in it adds no bias.
double photosynthesis_at_points(const RadiationModel& model, const RadiationResult& result) {
  const Surfaces surfaces(model);
  const glm::dvec3 to_sun = direction_to_sun(*model.sun);
  double sum = 0.0;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    if (surfaces.at(e).role != Role::leaf) continue;
    const double area = area_m2(model.canopy.corners[e]);
    const double cosine = glm::dot(unit_normal(model.canopy.corners[e]), to_sun);
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    const double beam_w_m2 = model.bands[0].direct_w_m2 * std::abs(cosine) / to_sun.y;
    const double in_sun_w_m2 = beam_w_m2 * (cosine > 0.0 ? optics.upper : optics.lower)[0].absorptance();
    double lit_w_m2 = 0.0, other_w_m2 = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      lit_w_m2 += result.side_direct_w_m2(2 * e + side, area, model.bands[0].direct_w_m2);
      other_w_m2 +=
          result.side_indirect_w_m2(2 * e + side, area, 0) * (side == 0 ? optics.upper : optics.lower)[0].absorptance();
    }
    const double lit = beam_w_m2 > 0.0 ? lit_w_m2 / beam_w_m2 : 0.0;
    const double all_w_m2 = in_sun_w_m2 + other_w_m2;
    sum += area * (lit * all_w_m2 / (all_w_m2 + 150.0) + (1.0 - lit) * other_w_m2 / (other_w_m2 + 150.0));
  }
  return sum;
}

// The guide's rule: Gauss and Legendre's three points for light that is spread evenly about the mean of each class.
double photosynthesis_of(const ShadeClassResult& classes) {
  const auto rate = [](double absorbed_w_m2) { return absorbed_w_m2 / (absorbed_w_m2 + 150.0); };
  const auto of_class = [&](const Estimate& area_m2, const Estimate& absorbed, const Estimate& spread) {
    if (std::isnan(absorbed.value)) return 0.0;
    const double away = std::sqrt(1.8) * spread.value;
    return area_m2.value *
           (5.0 * rate(std::max(0.0, absorbed.value - away)) + 8.0 * rate(absorbed.value) + 5.0 * rate(absorbed.value + away)) /
           18.0;
  };
  return of_class(classes.sunlit_m2, classes.absorbed_sunlit[0], classes.sunlit_sd[0]) +
         of_class(classes.shaded_m2, classes.absorbed_shaded[0], classes.shaded_sd[0]);
}

// Under an overcast sky there is one class only, and the spread is that of sky and scattered light.
TEST_P(TriangleLight, InClassesServesALightCurve) {
  const double truth = photosynthesis_at_points(model_, run(to_the_truth, 99));
  const RadiationResult got = run(to_default, 4, ElementErrors::skip);
  double organs = 0.0, layers = 0.0, mean_of_organs = 0.0;
  for (std::size_t o = 0; o < got.organs.size(); ++o) {
    if (!model_.canopy.organs[o].name.starts_with("leaf")) continue;
    organs += photosynthesis_of(got.organs[o].classes);
    const double absorbed_w_m2 = got.organs[o].absorbed[0].value;
    mean_of_organs += got.organs[o].area_m2 * absorbed_w_m2 / (absorbed_w_m2 + 150.0);
  }
  for (std::size_t k = 0; k + 1 < got.layers.size(); ++k) layers += photosynthesis_of(got.layers[k].leaf_classes);
  std::printf("organs %+.2f %%, layers %+.2f %%, whole organs %+.2f %%\n", 100.0 * (organs / truth - 1.0),
              100.0 * (layers / truth - 1.0), 100.0 * (mean_of_organs / truth - 1.0));
  EXPECT_NEAR(organs / truth, 1.0, 0.01);
  EXPECT_NEAR(layers / truth, 1.0, 0.01);
  EXPECT_GT(mean_of_organs / truth, model_.has_beam() ? 1.2 : 1.02);
}

TEST_P(TriangleLight, HasHonestErrors) {
  const Leaves truth = leaves(to_the_truth, 99);
  for (const double work : {to_two_percent, to_default}) {
    const Leaves got = leaves(work, 3);
    EXPECT_LT(difference(got, truth), 0.5 * difference(leaves(work, 3, ElementErrors::skip), truth)) << work;
    double all = covered(got, truth, [](std::size_t) { return true; });
    EXPECT_GE(all, 0.92) << work;
    EXPECT_LE(all, 0.99) << work;
    std::vector<std::uint64_t> sorted = got.landings;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const std::uint64_t middle = sorted[sorted.size() / 2];
    if (!model_.has_beam()) continue;
    EXPECT_GE(covered(got, truth, [&](std::size_t k) { return got.landings[k] <= middle; }), 0.92) << work;
    EXPECT_GE(covered(got, truth, [&](std::size_t k) { return got.landings[k] > middle; }), 0.92) << work;
  }
}

TEST_P(TriangleLight, LeavesAllSumsAndFiguresAsTheyWere) {
  RadiationResult refined = run(to_two_percent, 5);
  const RadiationResult counted = run(to_two_percent, 5, ElementErrors::skip);
  const Surfaces surfaces(model_);
  std::vector<std::int64_t> direct(surfaces.of.size() * 2), indirect = direct, sky = direct;
  for (std::size_t e = 0; e < model_.canopy.size(); ++e) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t place = 2 * surfaces.number_of[e] + side;
      const auto landed = static_cast<std::int64_t>(side == 0 ? counted.elements[e].upper : counted.elements[e].lower);
      if (model_.has_beam()) direct[place] += refined.side_direct[2 * e + side] - landed * RadiationResult::parts_per_landing;
      indirect[place] += refined.side_indirect[2 * e + side] - counted.side_indirect[2 * e + side];
      if (model_.has_sky()) sky[place] += refined.side_sky[2 * e + side] - counted.side_sky[2 * e + side];
    }
  }
  const std::vector<std::int64_t> none(direct.size());
  EXPECT_EQ(direct, none);
  EXPECT_EQ(indirect, none);
  EXPECT_EQ(sky, none);
  refined.side_direct.clear();
  refined.element_error.clear();
  refined.side_error.clear();
  refined.triangle_relative_error.clear();
  refined.side_indirect = counted.side_indirect;
  refined.side_sky = counted.side_sky;
  EXPECT_EQ(all_numbers(refined), all_numbers(counted));
}

TEST_P(TriangleLight, CanBeBounded) {
  SolveSettings settings;
  settings.element_errors = ElementErrors::refine;
  settings.accuracy.of = ErrorTarget::triangle;
  settings.accuracy.direct = settings.accuracy.indirect = 0.12;
  const RadiationResult result = simulate(model_, prepared_, settings);
  EXPECT_EQ(result.stop, StopReason::bound_reached);
  EXPECT_LE(result.direct.relative_error.value(), 0.12);
  EXPECT_LE(result.indirect.relative_error.value(), 0.12);
  EXPECT_EQ(result.indirect.judged.value().of, JudgedFigure::Of::triangles);
  // The typical error of both together lies below the bound of each, since the larger part is known better.
  EXPECT_GT(result.triangle_relative_error.at(0), 0.02);
  EXPECT_LT(result.triangle_relative_error.at(0), 0.14);
}

// A tracer for one thread at a time, as those of GPUs are. It notes if two threads trace at once.
class TracerOfOneThread final : public WrappedTracer {
 public:
  using WrappedTracer::WrappedTracer;

  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    const Visit visit(*this);
    return WrappedTracer::count_beam(beam, counters, stop);
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    const Visit visit(*this);
    return WrappedTracer::trace(scene, packets, landings, stop);
  }

  [[nodiscard]] int calls() const { return calls_; }
  [[nodiscard]] bool had_two_at_once() const { return had_two_at_once_; }

 private:
  // Stays long enough for another thread to come in.
  struct Visit {
    explicit Visit(TracerOfOneThread& tracer) : tracer_(tracer) {
      ++tracer_.calls_;
      if (++tracer_.inside_ > 1) tracer_.had_two_at_once_ = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ~Visit() { --tracer_.inside_; }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    TracerOfOneThread& tracer_;
  };
  std::atomic<int> inside_ = 0, calls_ = 0;
  std::atomic<bool> had_two_at_once_ = false;
};

// Pilots that are far too small are left early, while others of them are in the making; then triangles are judged.
TEST_P(TriangleLight, IsJudgedWithoutASecondThreadInTheTracer) {
  CpuTracer inner(prepared_.bvh, tracer_scene(model_));
  TracerOfOneThread tracer(inner);
  SolveSettings settings;
  settings.element_errors = ElementErrors::refine;
  settings.accuracy.of = ErrorTarget::triangle;
  settings.accuracy.direct = settings.accuracy.indirect = 1e-4;
  settings.replicates_at_once = 4;
  Monitor monitor;
  std::atomic<int> pilots = 0;
  monitor.report = [&](const Progress& progress) { pilots += progress.stage == Progress::Stage::pilot ? 1 : 0; };
  monitor.interrupted = [&] { return pilots > glanced_pilots; };  // the second series has begun
  static_cast<void>(solve(model_, prepared_.layout, tracer, settings, monitor));
  EXPECT_GT(tracer.calls(), glanced_pilots);
  EXPECT_FALSE(tracer.had_two_at_once());
}

// Small leaves of one or two triangles each, none of which any neighbour helps.
RadiationModel small_leaves(int corners, bool overcast) {
  Random random(11);
  MeshMaker maker;
  for (int number = 1; number <= 40; ++number) {
    maker.organ("leaf", 1, number);
    const glm::dvec3 centre_m(random.uniform(0.0, 1.0), random.uniform(0.1, 0.5), random.uniform(0.0, 1.0));
    const glm::dvec3 normal = inclined(random.uniform(0.0, 0.6), random.uniform(0.0, 6.0));
    maker.polygon(centre_m, normal, random.uniform(0.0005, 0.01), corners, random.uniform(0.0, 1.5));
  }
  RadiationModel model = leaf_model(maker.mesh(), unit_plot, sun_at(80.0, 120.0), std::array{par_band});
  model.bands[0].direct_w_m2 = overcast ? 0.0 : 350.0;
  if (overcast) {
    model.sky = SkyModel{.kind = SkyKind::overcast};
    model.bands[0].diffuse_w_m2 = 150.0;
  }
  return model;
}

// One leaf that covers most of the plot, and whose light is known far better than that of the small ones below.
RadiationModel below_a_roof() {
  Random random(5);
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.polygon({0.5, 0.6, 0.5}, {0.0, 1.0, 0.0}, 0.81, 4, 0.25 * std::numbers::pi);
  for (int number = 2; number <= 21; ++number) {
    maker.organ("leaf", 1, number);
    maker.polygon({random.uniform(0.0, 1.0), random.uniform(0.1, 0.3), random.uniform(0.0, 1.0)}, {0.0, 1.0, 0.0}, 0.0016, 4,
                  0.3);
  }
  RadiationModel model = black_model(maker.mesh(), unit_plot, sun_at(60.0, 90.0));
  model.sun.reset();
  model.bands[0].direct_w_m2 = 0.0;
  model.bands[0].diffuse_w_m2 = 100.0;
  model.sky = SkyModel{.kind = SkyKind::overcast};
  return model;
}

TEST(TriangleLightOfSmallLeaves, IsNoBetterKnownBelowALargeLeaf) {
  const RadiationModel model = below_a_roof();
  const Prepared prepared(model);
  const auto run = [&](double packets, std::uint64_t seed) {
    SolveSettings settings = fixed_scatter(model, {.rays = 1e3, .packets = packets, .seed = seed});
    settings.element_errors = ElementErrors::refine;
    return leaves_of_run(model, simulate(model, prepared, settings));
  };
  const Leaves truth = run(1e5, 99);
  const auto is_small = [&](std::size_t k) { return truth.area_m2[k] < 0.01; };
  constexpr std::uint64_t seeds = 40;
  for (const double packets : {300.0, 800.0}) {
    double held = 0.0, least = 1.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const double own = covered(run(packets, seed), truth, is_small);
      held += own / seeds;
      least = std::min(least, own);
    }
    std::printf("%.0f packets: %.3f of the area held, %.3f at least\n", packets, held, least);
    EXPECT_GE(held, 0.92);
    EXPECT_GE(least, 0.6);
  }
}

// The light of a leaf is that of its triangles, and so is its error where there are few of them: what landed on the leaf varies.
TEST(TriangleLightOfSmallLeaves, IsAsUncertainAsThatOfTheLeaves) {
  for (const auto& [corners, overcast] : {std::pair{4, false}, std::pair{3, false}, std::pair{3, true}}) {
    const RadiationModel model = small_leaves(corners, overcast);
    const Prepared prepared(model);
    const auto run = [&](double rays, std::uint64_t seed) {
      SolveSettings settings = fixed_scatter(model, {.rays = rays, .packets = rays / usual_replicates, .seed = seed});
      settings.element_errors = ElementErrors::refine;
      return simulate(model, prepared, settings);
    };
    const Leaves truth = leaves_of_run(model, run(1e6, 99));
    double held = 0.0, ratio = 0.0;
    constexpr std::uint64_t seeds = 6;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const RadiationResult result = run(2e4, seed);
      const Leaves got = leaves_of_run(model, result);
      held += covered(got, truth, [](std::size_t) { return true; }) / seeds;
      double of_triangles = 0.0, of_leaves = 0.0;
      for (std::size_t e = 0; e < got.area_m2.size(); ++e) of_triangles += got.area_m2[e] * got.error_w_m2[e];
      for (const OrganResult& organ : result.organs) of_leaves += organ.area_m2 * organ.absorbed[0].half_width;
      ratio += of_triangles / of_leaves / seeds;
    }
    EXPECT_GE(held, 0.92) << corners << overcast;
    EXPECT_GE(ratio, 0.9) << corners << overcast;
    EXPECT_LE(ratio, 1.5) << corners << overcast;
    std::printf("corners %d: %.3f of the area held, half-widths %.2f times those of leaves\n", corners, held, ratio);
  }
}

}  // namespace
}  // namespace sunfleck::test

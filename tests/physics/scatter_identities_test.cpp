// Tests what must hold in every scene whose leaves reflect and transmit (B14 of the validation table), and that a run gives the
// same numbers with any number of threads.
#include "base/error.h"
#include "base/threads.h"
#include "support/comparison.h"
#include "support/leaf_scenes.h"
#include "support/result_numbers.h"
#include "support/same_stands.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

RadiationModel leafy_model(const Plot& ground = stand_plot) {
  return paper_model(leafy_stand(), ground, beijing_sun());
}

RadiationModel placed_paper_model(const Plot& ground, const SunPosition& sun, const std::vector<Placement>& placements) {
  RadiationModel model = paper_model(leafy_stand(), ground, sun);
  place_stand(model, placements);
  return model;
}

RadiationResult run_scatter(const RadiationModel& model, std::uint64_t seed = 1) {
  return simulate(model, fixed_scatter(model, {.rays = 5e5, .packets = 8192, .seed = seed}));
}

const RadiationResult& usual_run() {
  static const RadiationResult result = run_scatter(leafy_model());
  return result;
}

// B14 (i), with bands that end after one landing, after several, and never.
TEST(ScatterIdentities, LedgerClosesInIntegers) {
  const std::array bands = {par_band,
                            nir_band,
                            LeafBand{"white", 0.6, 0.4, 1.0},
                            LeafBand{"black", 0.0, 0.0, 0.0},
                            LeafBand{"soil only", 0.0, 0.0, 0.3},
                            LeafBand{"clear", 0.0, 1.0, 0.2}};
  for (const bool periodic : {true, false}) {
    for (const bool has_soil : {true, false}) {
      RadiationModel model = black_model(leafy_stand(), {1.0, 1.5, periodic}, beijing_sun());
      if (!has_soil) model.soil.reset();
      set_leaf_bands(model, bands);
      const RadiationResult result = simulate(model, fixed_scatter(model, {.rays = 1e5, .packets = 2048, .replicates = 8}));
      EXPECT_EQ(result.lost_rays, 0U);
      for (std::size_t b = 0; b < bands.size(); ++b) {
        const BandResult& band = result.bands[b];
        EXPECT_EQ(band.ledger.residual(), 0) << band.name;
        EXPECT_TRUE(band.ledger.transmitted == 0 || !has_soil || !periodic) << band.name;
        EXPECT_TRUE(band.ledger.transmitted > 0 || has_soil) << band.name;
        EXPECT_LE(band.unshot, 1e-5 * band.incident.value) << band.name;
      }
      for (const std::size_t lossless : {2U, 5U}) EXPECT_EQ(result.bands[lossless].ledger.absorbed_vegetation, 0);
      EXPECT_EQ(result.bands[2].ledger.absorbed_soil, 0);
      EXPECT_EQ(result.bands[3].ledger.reflected, 0);
      EXPECT_EQ(result.bands[3].ledger.unshot, 0);
    }
  }
}

// 1 - 0.7 - 0.3 is not 0 in floating point.
TEST(ScatterIdentities, AbsorptanceIsNothingWhereEverythingIsScattered) {
  for (int hundredths = 0; hundredths <= 100; ++hundredths) {
    EXPECT_EQ((FaceOptics{hundredths / 100.0, (100 - hundredths) / 100.0}.absorptance()), 0.0) << hundredths;
  }
  EXPECT_EQ((FaceOptics{0.12, 0.06}.absorptance()), 1.0 - 0.12 - 0.06);
  EXPECT_GT((FaceOptics{0.7, 0.3 - 0x1p-32}.absorptance()), 0.0);
}

// B14 (ii).
TEST(ScatterIdentities, SoilAbsorbsItsShareOfWhatLandsOnIt) {
  const RadiationModel model = leafy_model();
  const RadiationResult& result = usual_run();
  for (std::size_t b = 0; b < 2; ++b) {
    const double absorptance = 1.0 - model.soil->reflectance[b];
    const double landed = soil_irradiance_w_m2(model, result, b);
    EXPECT_NEAR(landed * absorptance, result.bands[b].absorbed_soil.value, 1e-8);
    EXPECT_NEAR(result.layers[0].down[b].value, landed, 1e-8);
    EXPECT_NEAR(result.layers[0].up[b].value, landed * (1.0 - absorptance), 2e-4);
  }
}

// B14 (iv): the packets are the same, so the results agree except for the rounding to quanta.
TEST(ScatterIdentities, ThousandTimesTheLightGivesThousandTimesTheFlux) {
  const RadiationModel model = leafy_model();
  RadiationModel bright = model;
  for (Waveband& band : bright.bands) band.direct_w_m2 *= 1000.0;
  const RadiationResult& dim = usual_run();
  const RadiationResult lit = run_scatter(bright);
  const auto expect_scaled = [](const Estimate& small, const Estimate& large) {
    EXPECT_NEAR(large.value, 1000.0 * small.value, 1e-6 * large.value);
    EXPECT_NEAR(large.half_width, 1000.0 * small.half_width, 1e-3 * large.half_width);
  };
  for (std::size_t b = 0; b < 2; ++b) {
    expect_scaled(dim.bands[b].absorbed_vegetation, lit.bands[b].absorbed_vegetation);
    expect_scaled(dim.bands[b].absorbed_soil, lit.bands[b].absorbed_soil);
    expect_scaled(dim.bands[b].reflected, lit.bands[b].reflected);
    expect_scaled(dim.organs[3].absorbed[b], lit.organs[3].absorbed[b]);
  }
  EXPECT_EQ(dim.indirect.packets, lit.indirect.packets);
}

void expect_same_fluxes(const RadiationResult& b, const char* what) {
  const RadiationResult& a = usual_run();
  constexpr std::size_t comparisons = 24;
  for (std::size_t band = 0; band < 2; ++band) {
    const double largest = band == 0 ? 5e-4 : 1e-3;
    expect_same(a.bands[band].absorbed_vegetation, b.bands[band].absorbed_vegetation, usual_replicates, largest, comparisons,
                what);
    expect_same(a.bands[band].absorbed_soil, b.bands[band].absorbed_soil, usual_replicates, largest, comparisons, what);
    expect_same(a.bands[band].reflected, b.bands[band].reflected, usual_replicates, largest, comparisons, what);
  }
}

// B14 (v).
TEST(ScatterIdentities, ShiftChangesNothing) {
  expect_same_fluxes(run_scatter(placed_paper_model(stand_plot, beijing_sun(), {{{0.37, 0.0, 1.21}, 0.0}}), 2), "shifted");
}

TEST(ScatterIdentities, TurnOfStandSunAndPlotChangesNothing) {
  const SunPosition sun = beijing_sun();
  const SunPosition turned{sun.elevation_rad, sun.azimuth_rad + radians(90.0)};
  const Plot turned_plot{stand_plot.size_z_m, stand_plot.size_x_m, true};
  expect_same_fluxes(run_scatter(placed_paper_model(turned_plot, turned, {{glm::dvec3(0.0), radians(90.0)}}), 3), "turned");
}

// B14 (vii), with a leaf's own flux in addition to the aggregates: the place on a leaf where the light lands must be kept.
TEST(ScatterIdentities, TrianglesCutInFourChangeNothing) {
  const RadiationResult& whole = usual_run();
  const RadiationResult cut = run_scatter(paper_model(cut_in_four(cut_in_four(leafy_stand())), stand_plot, beijing_sun()), 4);
  expect_same_fluxes(cut, "cut in sixteen");
  for (std::size_t leaf = 0; leaf < 6; ++leaf) {
    expect_same(whole.organs[leaf].absorbed[1], cut.organs[leaf].absorbed[1], usual_replicates, 3e-3, 24, "a leaf, NIR");
  }
}

// B14 (viii).
TEST(ScatterIdentities, PlotOfFourCopiesChangesNothing) {
  expect_same_fluxes(
      run_scatter(placed_paper_model({2 * stand_plot.size_x_m, 2 * stand_plot.size_z_m, true}, beijing_sun(), four_copies()),
                  5),
      "four copies");
}

// B14 (ix).
TEST(ScatterIdentities, BlackScenesEndAtTheFirstLanding) {
  const RadiationModel model =
      leaf_model(leafy_stand(), stand_plot, beijing_sun(), std::array{LeafBand{"black", 0.0, 0.0, 0.0}});
  const RadiationResult result = run_scatter(model);
  EXPECT_EQ(result.indirect.packets, 0U);
  EXPECT_EQ(result.bands[0].ledger.reflected, 0);
  EXPECT_EQ(result.bands[0].ledger.unshot, 0);
  EXPECT_NEAR(result.bands[0].absorbed_vegetation.value, 1.0 - result.ground_sunfleck_ratio.value, 1e-9);
}

// The flux down through a plane minus the flux up is absorbed below the plane, or still unshot there. Each leaf reaches through
// several layers.
TEST(ScatterIdentities, NetFluxThroughEveryPlaneIsAbsorbedBelowIt) {
  for (const int layers : {1, 5, 20, 100}) {
    RadiationModel model = leafy_model();
    model.layers = layers;
    const ScatterWork work{.rays = 1e5, .packets = 4096, .replicates = 8, .bound = 0.01};
    const RadiationResult result = simulate(model, fixed_scatter(model, work));
    for (std::size_t b = 0; b < 2; ++b) {
      const BandResult& band = result.bands[b];
      double below = band.absorbed_soil.value;
      for (const LayerResult& layer : result.layers) {
        const double missing = layer.down[b].value - layer.up[b].value - below;
        EXPECT_LE(std::abs(missing), band.unshot + 1e-7) << band.name << ", " << layer.height_m << " m of " << layers;
        if (!layer.absorbed.empty()) below += layer.absorbed[b].value;
      }
      EXPECT_NEAR(below, band.absorbed_soil.value + band.absorbed_vegetation.value, 1e-8);
      const LayerResult& top = result.layers.back();
      EXPECT_NEAR(top.down[b].value, 1.0, 1e-7);
      EXPECT_NEAR(top.up[b].value, band.reflected.value, 1e-9);
      EXPECT_NEAR(top.down[b].value - top.up[b].value - below, band.unshot, 1e-8);
    }
  }
}

TEST(ScatterIdentities, SameNumbersWithOneAndTwoThreads) {
  const RadiationModel model = leafy_model();
  const Prepared prepared(model);
  SolveSettings settings = fixed_scatter(model, {.rays = 2e5, .packets = 20000, .replicates = 8});
  settings.element_errors = ElementErrors::keep;
  SolveSettings automatic;
  automatic.accuracy.direct = 0.01;
  automatic.accuracy.indirect = 0.02;
  for (const SolveSettings& how : {settings, automatic}) {
    std::vector<std::vector<std::uint64_t>> numbers;
    for (const int threads : {1, 2, 1}) {
      const CpuThreads limit(threads);
      numbers.push_back(all_numbers(simulate(model, prepared, how)));
    }
    EXPECT_GT(numbers[0].size(), 1000U);
    EXPECT_TRUE(numbers[1] == numbers[0]);
    EXPECT_TRUE(numbers[2] == numbers[0]);
    SolveSettings other = how;
    other.seed = 2;
    EXPECT_FALSE(all_numbers(simulate(model, prepared, other)) == numbers[0]);
  }
}

// Replicates that are traced at the same time are independent of each other, whether the work is fixed or determined by pilots.
TEST(ScatterIdentities, SameNumbersHoweverManyReplicatesAtOnce) {
  const RadiationModel model = leafy_model();
  const Prepared prepared(model);
  SolveSettings automatic;
  automatic.accuracy.direct = 0.01;
  automatic.accuracy.indirect = 0.02;
  for (SolveSettings how : {fixed_scatter(model, {.rays = 1e5, .packets = 10000, .replicates = 9}), automatic}) {
    std::vector<std::vector<std::uint64_t>> numbers;
    for (const int at_once : {1, 2, 5}) {
      how.replicates_at_once = at_once;
      numbers.push_back(all_numbers(simulate(model, prepared, how)));
    }
    EXPECT_TRUE(numbers[1] == numbers[0]);
    EXPECT_TRUE(numbers[2] == numbers[0]);
  }
}

// Records where beams land, or does not, so that the rays from which packets start are traced again.
class RecordingTracer final : public WrappedTracer {
 public:
  RecordingTracer(CpuTracer& inner, bool records) : WrappedTracer(inner), inner_(inner), records_(records) {}

  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings,
                                                        const StopQuestion& stop) override {
    ++asked_;
    if (!records_) return std::nullopt;
    return inner_.record_beam(beam, counters, landings, stop);
  }
  [[nodiscard]] int asked() const { return asked_; }

 private:
  CpuTracer& inner_;
  bool records_;
  int asked_ = 0;
};

TEST(ScatterIdentities, RecordedLandingsAreThoseOfRaysTracedAgain) {
  constexpr int replicates = 2;
  constexpr double packets = 2048.0;
  for (const bool periodic : {true, false}) {
    RadiationModel model = leafy_model({1.0, 1.5, periodic});
    if (!periodic) model.soil.reset();
    const Prepared prepared(model);
    for (const auto& [rays_per_packet, recorded] : {std::pair{0.8, true}, {1.7, true}, {2.6, false}}) {
      const SolveSettings settings =
          fixed_scatter(model, {.rays = rays_per_packet * packets * replicates, .packets = packets, .replicates = replicates});
      std::vector<std::vector<std::uint64_t>> numbers;
      for (const bool records : {true, false}) {
        CpuTracer cpu(prepared.bvh, tracer_scene(model));
        RecordingTracer tracer(cpu, records);
        numbers.push_back(all_numbers(solve(model, prepared.layout, tracer, settings, {})));
        EXPECT_EQ(tracer.asked(), recorded ? replicates : 0) << rays_per_packet << " rays per packet";
      }
      EXPECT_TRUE(numbers[0] == numbers[1]) << rays_per_packet << " rays per packet";
    }
  }
}

// A stopped run keeps the replicates that were complete, in their order; those being traced are discarded.
TEST(ScatterIdentities, StoppedBetweenReplicatesKeepsTheFirstOnes) {
  const RadiationModel model = leafy_model();
  const Prepared prepared(model);
  SolveSettings settings = fixed_scatter(model, {.rays = 1e5, .packets = 10000, .replicates = 12});
  settings.replicates_at_once = 3;
  std::atomic<bool> enough = false;
  Monitor monitor;
  int reports = 0;
  monitor.report = [&](const Progress&) { enough = ++reports >= 4; };
  monitor.interrupted = [&] { return enough.load(); };
  CpuTracer tracer(prepared.bvh, tracer_scene(model));
  const RadiationResult stopped = solve(model, prepared.layout, tracer, settings, monitor);
  EXPECT_EQ(stopped.stop, StopReason::interrupted);
  ASSERT_GE(stopped.direct.replicates, 4U);
  ASSERT_LE(stopped.direct.replicates, 7U);  // three more may have been complete by then
  SolveSettings fewer = settings;
  fewer.grid_m = *settings.grid_m * std::sqrt(12.0 / static_cast<double>(stopped.direct.replicates));
  fewer.passes = static_cast<int>(stopped.direct.replicates);
  EXPECT_TRUE(all_numbers(stopped) == all_numbers(simulate(model, prepared, fewer)));
}

// Takes turns as devices do, and pretends to keep where beams land. Either leaves the rounds to the host or fails.
class RoundsRefuser final : public WrappedTracer {
 public:
  RoundsRefuser(Tracer& inner, bool fails) : WrappedTracer(inner), fails_(fails) {}

  [[nodiscard]] TracerDevice device() const override {
    TracerDevice device = WrappedTracer::device();
    device.software = false;  // for which two replicates would be made at once
    return device;
  }
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override {
    return KeptBeam{count_beam(beam, counters, stop), std::make_shared<KeptLandings>()};
  }
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion&) override {
    passes_ += passes.size();
    EXPECT_LE(passes.size(), most_passes());
    if (fails_) throw_failure("rounds", "the device was lost", "use another one");
    return std::nullopt;
  }

  [[nodiscard]] std::size_t most_passes() const override { return 3; }

  [[nodiscard]] std::size_t passes() const { return passes_; }

 private:
  bool fails_;
  std::size_t passes_ = 0;
};

// Threads that wait for a device at the same time have their passes made together, and each of them gets the answer.
TEST(ScatterIdentities, PassesThatWaitTogetherAllGetTheAnswer) {
  const RadiationModel model = leafy_model({1.0, 1.5, true});
  const Prepared prepared(model);
  SolveSettings settings = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 12});
  settings.replicates_at_once = 5;
  CpuTracer cpu(prepared.bvh, tracer_scene(model));
  RoundsRefuser leaves_them(cpu, false), fails(cpu, true);
  const auto numbers = all_numbers(solve(model, prepared.layout, cpu, settings, {}));
  EXPECT_TRUE(all_numbers(solve(model, prepared.layout, leaves_them, settings, {})) == numbers);
  EXPECT_GE(leaves_them.passes(), 12U);  // those that are refused together are asked for again one by one
  EXPECT_THROW((void)solve(model, prepared.layout, fails, settings, {}), Error);
}

}  // namespace
}  // namespace sunfleck::test

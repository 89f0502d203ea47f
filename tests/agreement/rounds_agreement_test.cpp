// Tests that a device makes the rounds of indirect passes as the host does: every stage leaves the same integers and the same
// bits of packets, however the work is divided, and whole runs give the same numbers.

#include "agreement/scenes.h"
#include "agreement/stage_check.h"
#include "devices/tracers/vulkan_tracer.h"
#include "support/copies.h"
#include "support/device.h"
#include "support/leaf_scenes.h"
#include "support/result_numbers.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace sunfleck::test {
namespace {

// One copy of the small sums, some, and many.
constexpr shared::RoundChoices smallest{1, 64};
constexpr shared::RoundChoices odd{3, 64};
constexpr shared::RoundChoices usual{32, 64};

// Returns the choices of a device that makes this many rounds before the host looks.
VulkanChoices together(std::uint32_t rounds) {
  VulkanChoices choices;
  choices.rounds_at_once = rounds;
  return choices;
}

// Returns bounds that short runs meet.
SolveSettings coarse() {
  SolveSettings settings;
  settings.accuracy.direct = 0.2;
  settings.accuracy.indirect = 0.3;
  return settings;
}

RadiationModel leaves_on(const Plot& plot) {
  return paper_model(random_leaves(100, 0.12, 5), plot, beijing_sun());
}

// A leaf, a pole and a pot of soil over the plot's own soil.
RadiationModel with_every_role() {
  MeshMaker maker;
  maker.organ("leaf", 1, 1);
  maker.level(0.1, 0.9, 0.1, 0.6, 0.5);
  maker.organ("pole", 2, 1);
  maker.triangle({0.3, 0.0, 0.7}, {0.35, 1.0, 0.7}, {0.3, 1.0, 0.75});
  maker.organ("soil", 3, 1);
  maker.level(0.5, 0.8, 0.5, 0.8, 0.2);
  return paper_model(maker.mesh(), unit_plot, beijing_sun());
}

RadiationModel lit_by_lamps() {
  RadiationModel model = lamp_model(random_leaves(20, 0.2, 3), unit_plot, 2);
  for (SurfaceOptics& optics : model.optics) {
    optics.emission_w_m2 = {10.0, 0.0};
    for (std::size_t b = 0; b < 2; ++b) optics.upper[b].reflectance = optics.lower[b].reflectance = 0.4;
  }
  return model;
}

// A few leaves on a plot far wider than they are, on a plane of soil or above elements of soil.
RadiationModel lonely_leaves(bool above_elements) {
  Mesh mesh = random_leaves(20, 0.02, 5);
  if (above_elements) {
    MeshMaker maker;
    maker.organ("leaf");
    maker.level(0.1, 0.2, 0.1, 0.2, 0.1);
    maker.organ("soil");
    for (int k = 0; k < 4; ++k) maker.level(2.0 * k, 2.0 * k + 2.0, 0.0, 8.0, -0.01);
    mesh = maker.mesh();
  }
  RadiationModel model = paper_model(mesh, {9.0, 8.0, false}, beijing_sun());
  shine_from_sky(model, {});
  return above_elements ? without_soil(model) : model;
}

// Adds planes, some of them at the edges of layers, with cells of several sizes.
RadiationModel with_receivers(RadiationModel model) {
  model.planes = {{0.0, 3, 2}, {0.25, 7, 9}, {0.5, 1, 1}, {0.61803, 20, 30}, {1.0, 4, 4}, {1.5, 2, 2}};
  return model;
}

RadiationModel with_bands(std::size_t count) {
  std::vector<LeafBand> bands;
  for (std::size_t b = 0; b < count; ++b) {
    const double part = static_cast<double>(b) / static_cast<double>(count);
    bands.push_back({"band", 0.02 + 0.45 * part, 0.5 * part, 0.3 * (1.0 - part)});
  }
  RadiationModel model = leaf_model(random_leaves(50, 0.15, 5), unit_plot, beijing_sun(), bands);
  for (std::size_t b = 0; b < count; ++b) model.bands[b].name += std::to_string(b);
  return model;
}

// Counts the passes whose rounds a device makes.
class RoundsCounter final : public WrappedTracer {
 public:
  explicit RoundsCounter(Tracer& tracer) : WrappedTracer(tracer), tracer_(tracer) {}

  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override {
    return tracer_.keep_beam(beam, counters, stop);
  }
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override {
    const std::optional<TraceOutcome> outcome = tracer_.make_rounds(passes, stop);
    if (outcome) passes_ += passes.size();
    return outcome;
  }

  [[nodiscard]] std::size_t passes() const { return passes_; }

 private:
  Tracer& tracer_;
  std::size_t passes_ = 0;
};

// Makes each pass side by side with all passes before it, whose sums must be what they were. Every other beam is kept.
class SideBySide final : public WrappedTracer {
 public:
  explicit SideBySide(Tracer& tracer) : WrappedTracer(tracer), tracer_(tracer) {}

  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override {
    if (++beams_ % 2 == 0) return std::nullopt;
    return tracer_.keep_beam(beam, counters, stop);
  }
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override {
    for (const RoundsPass& pass : passes) {
      kept_.push_back(std::make_unique<Kept>(*pass.order));
      const std::optional<TraceOutcome> outcome = make_all(stop);
      if (outcome != TraceOutcome::finished) return outcome;
      *pass.sums = kept_.back()->sums;
    }
    return TraceOutcome::finished;
  }

  [[nodiscard]] std::size_t passes() const { return kept_.size(); }

 private:
  struct Kept {
    explicit Kept(const RoundsOrder& of)
        : places(of.places), order{of.scene, places, of.landings, of.block, of.packets, of.faces, of.columns, of.totals} {}
    WaitingFlux places;
    RoundsOrder order;
    RoundsSums sums;
  };

  [[nodiscard]] std::optional<TraceOutcome> make_all(const StopQuestion& stop) {
    std::vector<RoundsSums> sums(kept_.size());
    std::vector<RoundsPass> all;
    for (std::size_t k = 0; k < kept_.size(); ++k) all.push_back({&kept_[k]->order, &sums[k]});
    const std::optional<TraceOutcome> outcome = tracer_.make_rounds(all, stop);
    kept_.back()->sums = sums.back();
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const RoundsSums& before = kept_[k]->sums;
      EXPECT_TRUE(sums[k].totals == before.totals && sums[k].side_landed == before.side_landed &&
                  sums[k].cell_landed == before.cell_landed && sums[k].surface_landed == before.surface_landed &&
                  sums[k].element_hits == before.element_hits && sums[k].packets == before.packets &&
                  sums[k].rounds == before.rounds)
          << "pass " << k << " of " << kept_.size();
    }
    return outcome;
  }

  Tracer& tracer_;
  std::size_t beams_ = 0;
  std::vector<std::unique_ptr<Kept>> kept_;
};

class RoundsAgreement : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (!RoundSteps::work_on(context().limits())) GTEST_SKIP() << "this device leaves the rounds to the host";
  }

  // Compares every stage of every round of two replicates.
  void expect_same_stages(const RadiationModel& model, double packets, const shared::RoundChoices& choices = usual,
                          std::uint32_t at_a_time = 1U << 17U) const {
    SolveSettings settings = fixed_scatter(model, {.rays = 4e3, .packets = packets, .replicates = 2, .bound = 0.01});
    if (packets > 1000) settings.element_errors = ElementErrors::keep;  // which counts hits
    const bool kept = compare_stages(model, settings, choices, at_a_time) > 0;
    EXPECT_EQ(kept, model.has_beam() && model.planes.empty());
  }

  // Does the same for a whole run. Returns from how many landings that the device kept packets started.
  std::uint64_t compare_stages(const RadiationModel& model, const SolveSettings& settings,
                               const shared::RoundChoices& choices = usual, std::uint32_t at_a_time = 1U << 17U) const {
    const Prepared prepared(model);
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    StageCheck check(context(), cpu, choices, at_a_time);
    const auto theirs = all_numbers(solve(model, prepared.layout, check, settings, {}));
    EXPECT_TRUE(theirs == all_numbers(solve(model, prepared.layout, cpu, settings, {})));
    EXPECT_GE(check.rounds(), 4U);
    return check.sampled();
  }

  // Compares the numbers of a whole run, whose dispatches are cut as `choices` say. `Wrapper` counts the passes made on the
  // device.
  template <class Wrapper = RoundsCounter>
  void expect_same_run(const RadiationModel& model, const SolveSettings& settings, VulkanChoices choices = {}) const {
    const Prepared prepared(model);
    const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
    choices.rounds_at = RoundsAt::device;
    VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words(), choices);
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    Wrapper counter(device);
    const auto theirs = all_numbers(solve(model, prepared.layout, counter, settings, {}));
    EXPECT_GT(counter.passes(), 0U) << "the host made all rounds";
    const RadiationResult result = solve(model, prepared.layout, cpu, settings, {});
    EXPECT_GT(result.indirect.packets, 0U);
    EXPECT_TRUE(theirs == all_numbers(result));
  }
};

TEST_F(RoundsAgreement, OfEveryStage) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    expect_same_stages(leaves_on(plot), 3000);
    expect_same_stages(without_soil(leaves_on(plot)), 3000);
  }
}

TEST_F(RoundsAgreement, OfEveryStageHoweverTheWorkIsDivided) {
  const RadiationModel model = leaves_on(unit_plot);
  expect_same_stages(model, 700, smallest, 64);
  expect_same_stages(model, 3000, odd, 1000);
}

TEST_F(RoundsAgreement, OfEveryStageAmongLeavesPolesAndPots) {
  const RadiationModel model = with_every_role();
  expect_same_stages(model, 2000);
  expect_same_stages(without_soil(model), 2000);
}

// Copies of two plants share their meshes' corners; one mesh has its own.
TEST_F(RoundsAgreement, OfEveryStageOnCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const RadiationModel model = stand_of_copies({plot, 10, true, 4}, true);
    ASSERT_FALSE(model.canopy.corners.copies().empty());
    ASSERT_FALSE(model.canopy.corners.own().empty());
    expect_same_stages(model, 3000);
  }
}

// Beams of several parts are not kept. The ground is a plane, or elements.
TEST_F(RoundsAgreement, OfEveryStageWithLightAimedAtAStand) {
  for (const bool above_elements : {false, true}) EXPECT_EQ(compare_stages(lonely_leaves(above_elements), coarse()), 0U);
}

// Receivers at the ground, between leaves and above them all, in scenes with and without soil and with lamps.
TEST_F(RoundsAgreement, OfEveryStageWithReceivers) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    expect_same_stages(with_receivers(leaves_on(plot)), 3000);
    expect_same_stages(with_receivers(without_soil(leaves_on(plot))), 3000);
  }
  expect_same_stages(with_receivers(with_every_role()), 2000);
  expect_same_stages(with_receivers(lit_by_lamps()), 3000);
}

// Thousands of packets leave each of few lamps, so many that a thread adds up several blocks of running sums.
TEST_F(RoundsAgreement, OfEveryStageWithLamps) {
  expect_same_stages(lit_by_lamps(), 150'000);
}

TEST_F(RoundsAgreement, OfEveryStageUnderTheSkyInManyBands) {
  RadiationModel model = with_bands(20);
  expect_same_stages(model, 1500);
  shine_from_sky(model, {});
  expect_same_stages(model, 1500);
}

// Almost nothing scatters in one band, and almost nothing is absorbed in another.
TEST_F(RoundsAgreement, OfEveryStageWithFaintAndBrightBands) {
  const std::vector<LeafBand> bands{{"faint", 0.005, 0.005, 0.01}, {"bright", 0.5, 0.45, 0.9}, {"black", 0.0, 0.0, 0.0}};
  expect_same_stages(leaf_model(random_leaves(100, 0.12, 5), unit_plot, beijing_sun(), bands), 3000);
}

TEST_F(RoundsAgreement, OfWholeRuns) {
  SolveSettings automatic;
  automatic.accuracy.direct = 0.02;
  automatic.accuracy.indirect = 0.05;
  for (const Plot& plot : {unit_plot, unit_stand}) {
    RadiationModel model = leaves_on(plot);
    expect_same_run(model, automatic);
    SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 4, .bound = 0.01});
    fixed.element_errors = ElementErrors::refine;
    shine_from_sky(model, {});
    expect_same_run(model, fixed);
    expect_same_run(without_soil(model), fixed);
  }
}

// What lands is then kept as lists.
TEST_F(RoundsAgreement, OfWholeRunsOfFewPacketsAmongManyLeaves) {
  const RadiationModel model = paper_model(random_leaves(5000, 0.02, 5), unit_plot, beijing_sun());
  expect_same_run(model, fixed_scatter(model, {.rays = 500, .packets = 500, .replicates = 4, .bound = 0.05}));
}

TEST_F(RoundsAgreement, OfWholeRunsInShortDispatches) {
  const RadiationModel model = leaves_on(unit_plot);
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e3, .packets = 1000, .replicates = 2, .bound = 0.01});
  for (const VulkanChoices cut : {VulkanChoices{64, 32}, VulkanChoices{1000, 128}}) expect_same_run(model, fixed, cut);
}

TEST_F(RoundsAgreement, OfWholeRunsInSeveralRoundsAtOnce) {
  RadiationModel model = leaves_on(unit_plot);
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 4, .bound = 0.01});
  for (const std::uint32_t rounds : {2U, 8U, 40U}) expect_same_run(model, fixed, together(rounds));
  expect_same_run(lit_by_lamps(), fixed_scatter(model, {.packets = 20'000, .replicates = 2}), together(8));
  shine_from_sky(model, {});
  expect_same_run(model, fixed, together(8));
}

// Five passes need two lanes three times. Those of lamps end after other numbers of rounds.
TEST_F(RoundsAgreement, OfPassesSideBySide) {
  RadiationModel model = leaves_on(unit_plot);
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 5, .bound = 0.01});
  VulkanChoices two = together(4);
  two.lanes = 2;
  expect_same_run<SideBySide>(model, fixed, two);
  expect_same_run<SideBySide>(without_soil(model), fixed, together(2));
  expect_same_run<SideBySide>(model, fixed, together(1));  // one after the other
  expect_same_run<SideBySide>(lit_by_lamps(), fixed_scatter(model, {.packets = 2000, .replicates = 4}), together(8));
}

TEST_F(RoundsAgreement, OfWholeRunsOnCopiesThatShareATree) {
  RadiationModel model = stand_of_copies({unit_plot, 10, true, 4}, true);
  shine_from_sky(model, {});
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e3, .packets = 2000, .replicates = 4, .bound = 0.01});
  expect_same_run(model, fixed);
  expect_same_run(model, fixed, together(8));
}

TEST_F(RoundsAgreement, OfWholeRunsWithLightAimedAtAStand) {
  expect_same_run(lonely_leaves(false), coarse());
  expect_same_run(lonely_leaves(true), coarse(), together(8));
}

// What the host counts as passing each plane and as waiting in each zone, and what lamps send through them.
TEST_F(RoundsAgreement, OfWholeRunsWithReceivers) {
  RadiationModel model = with_receivers(stand_of_copies({unit_plot, 10, true, 4}, true));
  shine_from_sky(model, {});
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e3, .packets = 2000, .replicates = 4, .bound = 0.01});
  expect_same_run(model, fixed, together(8));
  expect_same_run(with_receivers(lit_by_lamps()), fixed_scatter(model, {.packets = 2000, .replicates = 2}));
}

// The columns of packets are then two bands in three lights.
TEST_F(RoundsAgreement, OfLightsThatShareTheirPackets) {
  std::vector<RadiationModel> moments;
  for (const double elevation_deg : {20.0, 45.0, 70.0}) {
    moments.push_back(paper_model(random_leaves(100, 0.12, 5), unit_plot, sun_at(elevation_deg, 150.0)));
  }
  shine_from_sky(moments.back(), {});
  const Prepared prepared(moments.front());
  const SolveSettings fixed = fixed_scatter(moments.front(), {.rays = 4e4, .packets = 3000, .replicates = 4, .bound = 0.01});
  const auto numbers_of = [&](Tracer& tracer) {
    std::vector<std::uint64_t> numbers;
    const auto take = [&](std::size_t, const RadiationResult& result, const SharedOutcome&) {
      const std::vector<std::uint64_t> own = all_numbers(result);
      numbers.insert(numbers.end(), own.begin(), own.end());
    };
    (void)solve_lights(moments, prepared.layout, tracer, fixed, {}, nullptr, {}, take);
    return numbers;
  };
  const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
  VulkanChoices choices = together(8);
  choices.rounds_at = RoundsAt::device;
  VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(moments.front()), prepared.layout.words(), choices);
  CpuTracer cpu(prepared.bvh, tracer_scene(moments.front()));
  RoundsCounter counter(device);
  EXPECT_TRUE(numbers_of(counter) == numbers_of(cpu));
  EXPECT_GE(counter.passes(), 4U);
}

// A period of 5 cm lies below a leaf 12 m high: level packets pass thousands of periods and pause between dispatches.
TEST_F(RoundsAgreement, OfWholeRunsWithPausedPackets) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 12.0);
  maker.level(0.01, 0.04, 0.01, 0.04, 0.01);
  const RadiationModel model = paper_model(maker.mesh(), {0.05, 0.05, true}, sun_at(60.0, 30.0));
  const SolveSettings fixed = fixed_scatter(model, {.rays = 200, .packets = 1000, .replicates = 2, .bound = 0.05});
  expect_same_run(model, fixed);
  expect_same_run(model, fixed, together(3));
  expect_same_run<SideBySide>(model, fixed, together(3));
}

// Packets that meet all leaves of a pile are left to the CPU.
TEST_F(RoundsAgreement, OfWholeRunsWithAPileTooHighForOneDispatch) {
  MeshMaker maker;
  add_pile(maker, 20'000, 1.0, 0.5);
  const RadiationModel model = paper_model(maker.mesh(), unit_plot, sun_at(60.0, 30.0));
  const SolveSettings fixed = fixed_scatter(model, {.rays = 60, .packets = 60, .replicates = 2, .bound = 0.5});
  expect_same_run(model, fixed);
  expect_same_run(model, fixed, together(3));
  expect_same_run<SideBySide>(model, fixed, together(3));
}

// Measures what a device is given in fixed work.
class RoundsTraffic : public RoundsAgreement {
 protected:
  struct Measured {
    RadiationResult result;
    DeviceTraffic traffic;
  };

  [[nodiscard]] Measured measure(const RadiationModel& model, double packets, VulkanChoices choices) const {
    const Prepared prepared(model);
    const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
    choices.rounds_at = RoundsAt::device;
    VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words(), choices);
    const DeviceTraffic before = context().traffic();
    const SolveSettings fixed =
        fixed_scatter(model, {.rays = 4e4, .packets = packets, .replicates = replicates, .bound = 0.01});
    const RadiationResult result = solve(model, prepared.layout, device, fixed, {});
    const DeviceTraffic after = context().traffic();
    return {result,
            {after.submissions - before.submissions, after.uploaded_bytes - before.uploaded_bytes,
             after.downloaded_bytes - before.downloaded_bytes}};
  }

  static constexpr int replicates = 8;
};

// The host waits twice a round: for the number of packets, and for their way.
TEST_F(RoundsTraffic, TakesTwoSubmissionsARoundAndNoPacketToTheHost) {
  const RadiationModel model = leaves_on(unit_plot);
  const Measured few = measure(model, 6000, together(1));
  const Measured many = measure(model, 12'000, together(1));
  // One each for the beam, for its counters and for the sums. The last look at the state takes one, the first goes with the pass.
  EXPECT_EQ(many.traffic.submissions, 4 * replicates + 2 * many.result.indirect.rounds);
  EXPECT_GT(many.result.indirect.packets, 3 * few.result.indirect.packets / 2);
  // A round sends and fetches how many packets have paused, and fetches its state.
  const std::uint64_t further_rounds = many.result.indirect.rounds - few.result.indirect.rounds;
  EXPECT_EQ(many.traffic.uploaded_bytes - few.traffic.uploaded_bytes, 4 * further_rounds);
  EXPECT_EQ(many.traffic.downloaded_bytes - few.traffic.downloaded_bytes, (4 + sizeof(shared::RoundState)) * further_rounds);
}

// The device keeps where the beam landed and draws the sample there, so that what it is given does not grow with rays or packets.
TEST_F(RoundsTraffic, BringsNoPlaceToTheDevice) {
  const RadiationModel model = leaves_on(unit_plot);
  const std::size_t scene = model.canopy.size() * (sizeof(Triangle) + sizeof(shared::RoundElement));
  VulkanChoices one_lane = together(40);
  one_lane.lanes = 1;  // passes side by side share 60 bytes
  std::vector<std::uint64_t> uploaded;
  for (const double packets : {700.0, 12'000.0}) {
    uploaded.push_back(measure(model, packets, one_lane).traffic.uploaded_bytes - scene);
  }
  EXPECT_EQ(uploaded[0], uploaded[1]);
  EXPECT_LE(uploaded[1], 4096U * replicates);
}

// A device that makes as many rounds as there are before the host looks takes four submissions: beam, counters, rounds, sums.
// Passes side by side share the last two.
TEST_F(RoundsTraffic, TakesFourSubmissionsAReplicateWithRoundsTogether) {
  VulkanChoices one_lane = together(40);
  one_lane.lanes = 1;
  const Measured measured = measure(leaves_on(unit_plot), 6000, one_lane);
  EXPECT_LT(measured.result.indirect.rounds, 40U * replicates);
  EXPECT_EQ(measured.traffic.submissions, 4U * replicates);
  EXPECT_LE(measure(leaves_on(unit_plot), 6000, together(40)).traffic.submissions, 4U * replicates);
}

}  // namespace
}  // namespace sunfleck::test

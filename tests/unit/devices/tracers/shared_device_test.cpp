// Tests taking turns on one device, how long each turn lasts, and remembered beams.
#include "devices/tracers/shared_device.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/dispatch_budget.h"
#include "devices/tracers/remembered_beams.h"

#include "physics/bvh/build.h"
#include "physics/transport/model/beam_block.h"
#include "support/models.h"
#include "support/wrapped_tracer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <optional>
#include <thread>
#include <vector>

namespace sunfleck {
namespace {

TEST(DispatchBudget, WithoutATimeIsAlwaysTheMost) {
  DispatchBudget budget(1U << 17U, 0.0);
  budget.record_duration(1U << 17U, 10.0);
  EXPECT_EQ(budget.rays(), 1U << 17U);
}

TEST(DispatchBudget, FollowsASlowAndAFastDevice) {
  for (const double rays_per_second : {2e5, 1e6, 5e9}) {
    DispatchBudget budget(1U << 22U, 0.02);
    for (int k = 0; k < 30; ++k) budget.record_duration(budget.rays(), budget.rays() / rays_per_second);
    const double wanted = std::clamp(0.02 * rays_per_second, 4096.0, static_cast<double>(1U << 22U));
    EXPECT_NEAR(budget.rays(), wanted, 0.01 * wanted);
  }
}

TEST(DispatchBudget, GrowsStepByStepAndLearnsNothingFromRemainders) {
  DispatchBudget budget(1U << 20U, 0.02);
  const std::uint32_t first = budget.rays();
  budget.record_duration(first, 1e-9);
  EXPECT_EQ(budget.rays(), 2 * first);
  budget.record_duration(17, 1.0);
  EXPECT_EQ(budget.rays(), 2 * first);
  DispatchBudget small(1000, 0.02);
  EXPECT_EQ(small.rays(), 1000U);
  small.record_duration(1000, 9.0);
  EXPECT_EQ(small.rays(), 1000U);
}

// A thread that draws gets its turn between two dispatches of one that traces, and never do two have the device at once.
TEST(DeviceTurn, LetsDrawingsInBetweenDispatches) {
  DeviceTurn turn;
  std::atomic<int> inside = 0;
  std::atomic<int> drawings = 0;
  std::atomic<bool> clash = false;
  std::atomic<bool> done = false;
  std::thread tracing([&] {
    const TracingTurn all(turn);
    while (drawings < 50) {
      clash = clash || inside.fetch_add(1) != 0;
      inside.fetch_sub(1);
      turn.give_way();
    }
    done = true;
  });
  while (drawings < 50) {
    const DrawingTurn mine(turn);
    clash = clash || inside.fetch_add(1) != 0;
    EXPECT_FALSE(done);
    inside.fetch_sub(1);
    ++drawings;
  }
  tracing.join();
  EXPECT_FALSE(clash);
}

struct Stand {
  Stand() {
    MeshMaker maker;
    for (int k = 0; k < 20; ++k) maker.polygon({0.05 * k, 0.02 * k, 0.5}, {0.3, 1.0, 0.1 * k}, 0.02, 6);
    model = black_model(maker.mesh(), {1.0, 1.0, true}, sun_at(50, 130));
    layout = make_counter_layout(model);
    bvh = build_bvh(model.canopy, box_padding_m(model));
    number_counters(layout, model.canopy, bvh);
  }
  [[nodiscard]] std::vector<std::uint32_t> trace(Tracer& tracer, std::uint64_t replicate, const SunPosition& sun) {
    model.sun = sun;
    std::vector<std::uint32_t> counters(layout.words(), 3);  // landings are added to the present counts
    EXPECT_EQ(tracer.count_beam(make_beam_block(model, layout, 5000, 1, replicate), counters, {}), TraceOutcome::finished);
    return counters;
  }
  RadiationModel model;
  CounterLayout layout;
  Bvh bvh;
};

// A ray of this sun crosses 30,000 periods, so that a single slice of all rays would take minutes.
TEST(CpuTracer, AsksOftenWhetherToStopWhereTheSunIsLow) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  stand.model.sun = sun_at(0.001, 130);
  int asked = 0;
  const auto stop = [&] { return ++asked > 1; };
  std::vector<std::uint32_t> counters(stand.layout.words());
  const shared::BeamBlock beam = make_beam_block(stand.model, stand.layout, 100'000, 1, 0);
  EXPECT_EQ(cpu.count_beam(beam, counters, stop), TraceOutcome::stopped);
  std::vector<shared::Packet> packets;
  for (std::uint32_t ray = 0; ray < 100'000; ++ray) packets.push_back(beam_packet(beam, ray % (beam.columns * beam.rows)));
  std::vector<shared::Landing> landings(packets.size());
  asked = 0;
  EXPECT_EQ(cpu.trace(make_packet_block(stand.model, stand.layout), packets, landings, stop), TraceOutcome::stopped);
}

TEST(RememberedBeams, CountTheSameWithoutTracing) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  RememberedBeams remembered(cpu, 1U << 20U);
  const SunPosition sun = sun_at(50, 130);
  for (const std::uint64_t spared : {0, 0, 2}) {
    EXPECT_EQ(remembered.spared(), spared);
    for (const std::uint64_t replicate : {0, 1})
      EXPECT_EQ(stand.trace(remembered, replicate, sun), stand.trace(cpu, replicate, sun));
  }
  EXPECT_EQ(remembered.spared(), 4U);
  const SunPosition other = sun_at(51, 130);
  EXPECT_EQ(stand.trace(remembered, 0, other), stand.trace(cpu, 0, other));
  EXPECT_EQ(remembered.spared(), 4U) << "another sun is another beam";
  EXPECT_EQ(stand.trace(remembered, 0, sun), stand.trace(cpu, 0, sun));
  EXPECT_EQ(remembered.spared(), 4U) << "the first beams made room for those of the other sun";
}

TEST(RememberedBeams, AreRecordedOnce) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  RememberedBeams remembered(cpu, 1U << 20U);
  const shared::BeamBlock beam = make_beam_block(stand.model, stand.layout, 5000, 1, 0);
  std::vector<shared::Landing> landings(beam.columns * beam.rows), expected(landings.size());
  std::vector<std::uint32_t> counters(stand.layout.words(), 3), counted(stand.layout.words(), 3);
  EXPECT_EQ(remembered.record_beam(beam, counters, landings, [] { return true; }), TraceOutcome::stopped);
  EXPECT_EQ(counters, counted) << "nothing half-counted";
  EXPECT_EQ(remembered.record_beam(beam, counters, landings, {}), TraceOutcome::finished);
  EXPECT_EQ(cpu.record_beam(beam, counted, expected, {}), TraceOutcome::finished);
  EXPECT_EQ(counters, counted);
  EXPECT_EQ(std::memcmp(landings.data(), expected.data(), landings.size() * sizeof landings[0]), 0);
  EXPECT_EQ(remembered.record_beam(beam, counters, landings, {}), std::nullopt) << "it is not traced again";
  EXPECT_EQ(counters, counted);
  EXPECT_EQ(stand.trace(remembered, 0, *stand.model.sun), counted);
  EXPECT_EQ(remembered.spared(), 1U);
}

// Counts beams and pretends to keep where they land.
class Keeper final : public test::WrappedTracer {
 public:
  using WrappedTracer::WrappedTracer;
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override {
    return KeptBeam{count_beam(beam, counters, stop), std::make_shared<KeptLandings>()};
  }
};

TEST(RememberedBeams, AreKeptOnce) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  Keeper keeper(cpu);
  RememberedBeams remembered(keeper, 1U << 20U);
  const shared::BeamBlock beam = make_beam_block(stand.model, stand.layout, 5000, 1, 0);
  std::vector<std::uint32_t> counters(stand.layout.words(), 3), counted(stand.layout.words(), 3);
  EXPECT_EQ(remembered.keep_beam(beam, counters, [] { return true; })->outcome, TraceOutcome::stopped);
  EXPECT_EQ(counters, counted) << "nothing half-counted";
  EXPECT_NE(remembered.keep_beam(beam, counters, {})->landings, nullptr);
  EXPECT_EQ(cpu.count_beam(beam, counted, {}), TraceOutcome::finished);
  EXPECT_EQ(counters, counted);
  EXPECT_FALSE(remembered.keep_beam(beam, counters, {})) << "it is not traced again";
  EXPECT_EQ(counters, counted);
}

TEST(RememberedBeams, WithoutRoomAreTracedEachTime) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  RememberedBeams remembered(cpu, 16);
  const SunPosition sun = sun_at(50, 130);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(stand.trace(remembered, 0, sun), stand.trace(cpu, 0, sun));
  EXPECT_EQ(remembered.spared(), 0U);
}

TEST(RememberedBeams, ForgetABeamThatWasStopped) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  RememberedBeams remembered(cpu, 1U << 20U);
  std::vector<std::uint32_t> counters(stand.layout.words());
  const shared::BeamBlock beam = make_beam_block(stand.model, stand.layout, 5000, 1, 0);
  EXPECT_EQ(remembered.count_beam(beam, counters, [] { return true; }), TraceOutcome::stopped);
  EXPECT_EQ(counters, std::vector<std::uint32_t>(stand.layout.words())) << "nothing half-counted";
  EXPECT_EQ(stand.trace(remembered, 0, *stand.model.sun), stand.trace(cpu, 0, *stand.model.sun));
}

TEST(CpuTracer, CountsTheSameHoweverOftenItAsks) {
  Stand stand;
  CpuTracer cpu(stand.bvh, {true, true});
  CpuTracer often(stand.bvh, {true, true}, CpuWalk::tree, 1e-7);
  int questions = 0;
  std::vector<std::uint32_t> counters(stand.layout.words(), 3);
  const shared::BeamBlock beam = make_beam_block(stand.model, stand.layout, 50000, 1, 0);
  EXPECT_EQ(often.count_beam(beam, counters,
                             [&] {
                               ++questions;
                               return false;
                             }),
            TraceOutcome::finished);
  EXPECT_GT(questions, 8);
  std::vector<std::uint32_t> expected(stand.layout.words(), 3);
  EXPECT_EQ(cpu.count_beam(beam, expected, {}), TraceOutcome::finished);
  EXPECT_EQ(counters, expected);
}

}  // namespace
}  // namespace sunfleck

// Tests that beam rays followed in bundles are counted and recorded as single rays are, whatever the size of the grid and the
// part of it.
#include "devices/tracers/beam_bundles.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/packet_bundles.h"

#include "physics/transport/model/beam_block.h"
#include "shared/beam.h"
#include "support/models.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

namespace sunfleck::test {
namespace {

// What a beam left behind.
struct Landed {
  std::vector<std::uint32_t> counters;
  std::vector<shared::Landing> landings;  // [ray]

  friend bool operator==(const Landed& a, const Landed& b) {
    return a.counters == b.counters && a.landings.size() == b.landings.size() &&
           std::memcmp(a.landings.data(), b.landings.data(), a.landings.size() * sizeof(shared::Landing)) == 0;
  }
};

struct Case {
  explicit Case(RadiationModel of) : model(std::move(of)), prepared(model) {}

  [[nodiscard]] shared::BeamBlock beam(std::uint32_t columns, std::uint32_t rows) const {
    shared::BeamBlock block = make_beam_block(model, prepared.layout, 100.0, 1, 0);
    block.columns = columns;
    block.rows = rows;
    block.per_column = 1.0F / static_cast<float>(columns);
    block.per_row = 1.0F / static_cast<float>(rows);
    return block;
  }
  [[nodiscard]] Landed nothing(const shared::BeamBlock& beam) const {
    return {std::vector<std::uint32_t>(prepared.layout.words()), std::vector<shared::Landing>(beam.columns * beam.rows)};
  }
  [[nodiscard]] Landed in_bundles(const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end) const {
    Landed landed = nothing(beam);
    const LandingCounter counter(prepared.bvh, tracer_scene(model), beam, landed.counters, landed.landings);
    count_in_bundles(prepared.bvh, tracer_scene(model), beam, first, end, counter);
    return landed;
  }
  [[nodiscard]] Landed one_by_one(const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end) const {
    Landed landed = nothing(beam);
    const CpuTracer tracer(prepared.bvh, tracer_scene(model));
    for (std::uint32_t ray = first; ray < end; ++ray) {
      tracer.finish_ray(beam, {shared::beam_origin(beam, ray), 0, ray, 0}, landed.counters, {});
      landed.landings[ray] = tracer.follow_packet(scene, beam_packet(beam, ray), 0);
    }
    return landed;
  }

  RadiationModel model;
  Prepared prepared;
  shared::PacketBlock scene = make_packet_block(model, prepared.layout);
};

RadiationModel leaves_on(const Plot& plot, const SunPosition& sun) {
  return black_model(random_leaves(60, 0.02, plot, 0.8, 3), plot, sun);
}

TEST(BeamBundles, CountEachRayOfAGridOfAnySize) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const Case test(leaves_on(plot, sun_at(40, 130)));
    for (const auto& [columns, rows] :
         {std::pair{1U, 1U}, {1U, 9U}, {9U, 1U}, {4U, 4U}, {5U, 3U}, {7U, 6U}, {33U, 2U}, {13U, 17U}, {40U, 41U}}) {
      const shared::BeamBlock beam = test.beam(columns, rows);
      const Landed got = test.in_bundles(beam, 0, columns * rows);
      EXPECT_TRUE(got == test.one_by_one(beam, 0, columns * rows)) << columns << " x " << rows;
      const auto all = std::accumulate(got.counters.begin(), got.counters.end(), std::uint64_t{0});
      const std::uint64_t ends = all - got.counters[shared::counter_met];
      EXPECT_EQ(ends, std::uint64_t{columns} * rows);
    }
  }
}

TEST(BeamBundles, CountThePartThatWasAskedFor) {
  const Case test(leaves_on(unit_plot, sun_at(30, 200)));
  const shared::BeamBlock beam = test.beam(21, 10);
  for (const auto& [first, end] : {std::pair{0U, 0U}, {0U, 1U}, {3U, 4U}, {5U, 37U}, {80U, 90U}, {209U, 210U}}) {
    EXPECT_TRUE(test.in_bundles(beam, first, end) == test.one_by_one(beam, first, end)) << first << " to " << end;
  }
}

// A beam from low in the sky crosses many periods of a plot narrower than a bundle, and rays leave it by both borders.
TEST(BeamBundles, PassManySmallPeriods) {
  const Case test(leaves_on({0.05, 0.08, true}, sun_at(4, 37)));
  const shared::BeamBlock beam = test.beam(6, 9);
  EXPECT_TRUE(test.in_bundles(beam, 0, 54) == test.one_by_one(beam, 0, 54));
}

// Leaves below the ground stop only rays that pass the plot's ground by.
TEST(BeamBundles, EndOnTheGroundBeforeWhatIsBelow) {
  MeshMaker maker;
  maker.level(-0.5, 1.5, -0.5, 1.5, -0.3);
  maker.level(0.2, 0.5, 0.1, 0.6, 0.4);
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const Case test(black_model(maker.mesh(), plot, sun_at(35, 60)));
    const shared::BeamBlock beam = test.beam(30, 30);
    const Landed got = test.in_bundles(beam, 0, 900);
    EXPECT_GT(got.counters[shared::counter_first_cell], 0U);
    EXPECT_TRUE(got == test.one_by_one(beam, 0, 900));
  }
}

// Numbers that single precision holds exactly: each period lowers a ray by 2^-10 m, the first one by half as much.
TEST(BeamBundles, LoseRaysThatCrossTooManyPeriods) {
  const Case test(black_model({}, unit_plot, sun_at(45, 90)));
  shared::BeamBlock beam = test.beam(1, 1);
  beam.edge_u = beam.edge_v = {0.0F, 0.0F, 0.0F};
  beam.direction = {0.0F, -0x1p-10F, 1.0F};
  beam.ground.y = 0.0F;
  for (const int more : {-1, 0, 1}) {
    const float lowered = (static_cast<float>(shared::max_crossings) + static_cast<float>(more)) * 0x1p-10F;
    beam.corner = {0.5F, lowered + 0x1p-12F, 0.5F};
    const Landed got = test.in_bundles(beam, 0, 1);
    EXPECT_EQ(got.counters[shared::counter_lost], more > 0 ? 1U : 0U);
    EXPECT_EQ(got.landings[0].surface, more > 0 ? shared::lost_on_its_way : shared::landed_on_ground);
    std::vector<std::uint32_t> counters(got.counters.size());
    const shared::PausedRay ray{shared::beam_origin(beam, 0), 0, 0, 0};
    CpuTracer(test.prepared.bvh, tracer_scene(test.model)).finish_ray(beam, ray, counters, {});
    EXPECT_EQ(got.counters, counters);
  }
}

TEST(BeamBundles, PayWhereRaysAreClose) {
  const Case test(leaves_on(unit_plot, sun_at(40, 130)));
  constexpr float size_squared = 0.03F * 0.03F;
  EXPECT_TRUE(pays_in_bundles(test.beam(50, 50), size_squared));
  EXPECT_FALSE(pays_in_bundles(test.beam(10, 10), size_squared));
  EXPECT_FALSE(pays_in_bundles(test.beam(10, 1000), size_squared));
  EXPECT_FALSE(pays_in_bundles(test.beam(1000, 10), size_squared));
}

// The tracer follows the rays of a wide grid side by side, and those of a fine one in bundles.
TEST(BeamBundles, AreCountedAsTheTracerCountsGridsOfAnyWidth) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const Case test(leaves_on(plot, sun_at(25, 310)));
    CpuTracer tracer(test.prepared.bvh, tracer_scene(test.model));
    for (const auto& [side, fine] : {std::pair{1U, false}, {3U, false}, {150U, true}}) {
      const shared::BeamBlock beam = test.beam(side, side);
      EXPECT_EQ(pays_in_bundles(beam, triangle_size_squared(test.prepared.bvh)), fine);
      Landed got = test.nothing(beam);
      ASSERT_EQ(tracer.record_beam(beam, got.counters, got.landings, {}), TraceOutcome::finished);
      EXPECT_TRUE(got == test.one_by_one(beam, 0, side * side)) << side;
    }
  }
}

}  // namespace
}  // namespace sunfleck::test

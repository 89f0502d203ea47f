// Tests that the CPU walk, the CPU test of every element, and Vulkan count and record the same landings, word for word, however
// the work is cut.

#include "agreement/scenes.h"
#include "devices/tracers/canopy_view.h"
#include "devices/tracers/vulkan_tracer.h"
#include "physics/transport/model/beam_block.h"
#include "support/copies.h"
#include "support/device.h"
#include "support/landings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace sunfleck::test {
namespace {

using Counters = std::vector<std::uint32_t>;

Counters count(Tracer& tracer, const shared::BeamBlock& beam, const CounterLayout& layout) {
  Counters counters(layout.words());
  EXPECT_TRUE(tracer.count_beam(beam, counters, {}) == TraceOutcome::finished);
  return counters;
}

// Expects every ray to be counted once, and none to be lost.
void expect_all_counted(const Counters& counters, const shared::BeamBlock& beam, bool periodic) {
  const auto landed = std::accumulate(counters.begin(), counters.end(), std::uint64_t{0}) - counters[shared::counter_met];
  EXPECT_EQ(landed, std::uint64_t{beam.columns} * beam.rows);
  EXPECT_EQ(counters[shared::counter_lost], 0U);
  const std::uint32_t met = periodic ? 0U : beam.columns * beam.rows - counters[shared::counter_missed];
  EXPECT_EQ(counters[shared::counter_met], met);
}

std::size_t words_apart(const Counters& a, const Counters& b) {
  std::size_t apart = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
  for (std::size_t word = 0; word < std::min(a.size(), b.size()); ++word) apart += a[word] == b[word] ? 0 : 1;
  return apart;
}

// Returns where the rays of a beam land if they are traced as packets.
Landings trace_rays(Tracer& tracer, const RadiationModel& model, const CounterLayout& layout, const shared::BeamBlock& beam) {
  std::vector<shared::Packet> rays;
  for (std::uint32_t ray = 0; ray < beam.columns * beam.rows; ++ray) rays.push_back(beam_packet(beam, ray));
  return follow(tracer, make_packet_block(model, layout), rays);
}

struct Cut {
  BufferUse use;
  VulkanChoices choices;
};

class DeviceAgreement : public DeviceTest {
 protected:
  // Counts the landings of a beam, without and with a record of them.
  void expect_on_device(const RadiationModel& model, const Prepared& prepared, const shared::BeamBlock& beam, Cut cut,
                        const Counters& counters, const Landings& landings) const {
    SCOPED_TRACE("in dispatches of " + std::to_string(cut.choices.rays_per_dispatch));
    const GpuTree tree(context(), prepared.bvh, cut.use);
    const auto words = prepared.layout.words();
    VulkanTracer tracer(context(), prepared.bvh, tree, tracer_scene(model), words, cut.choices);
    EXPECT_EQ(words_apart(count(tracer, beam, prepared.layout), counters), 0U);
    Counters counted(words);
    Landings recorded(landings.size());
    EXPECT_EQ(tracer.record_beam(beam, counted, recorded, {}), TraceOutcome::finished);
    EXPECT_EQ(words_apart(counted, counters), 0U);
    EXPECT_EQ(landings_apart(recorded, landings), 0U);
  }

  // Also traces `doubted_rays` rays by testing every element.
  void expect_agreement(const RadiationModel& model, double rays, double doubted_rays) const {
    const Prepared prepared(model);
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    const shared::BeamBlock beam = make_beam_block(model, prepared.layout, rays, 1, 0);
    const Counters expected = count(cpu, beam, prepared.layout);
    expect_all_counted(expected, beam, model.plot.periodic);
    const Landings landings = trace_rays(cpu, model, prepared.layout, beam);
    for (const Cut& cut :
         {Cut{BufferUse::uniform_texel, {}}, Cut{BufferUse::storage, {1000, 128}}, Cut{BufferUse::uniform_texel, {64, 32}}}) {
      expect_on_device(model, prepared, beam, cut, expected, landings);
    }
    if (doubted_rays == 0) return;
    const shared::BeamBlock few = make_beam_block(model, prepared.layout, doubted_rays, 2, 0);
    CpuTracer doubter(prepared.bvh, tracer_scene(model), CpuWalk::every_element);
    EXPECT_EQ(words_apart(count(cpu, few, prepared.layout), count(doubter, few, prepared.layout)), 0U);
  }
};

TEST_F(DeviceAgreement, OnTwoMaizePlants) {
  expect_agreement(maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun()), 60'000, 1'000);
}

TEST_F(DeviceAgreement, OnCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand, Plot{0.3, 0.7, true}}) {
    for (const bool of_all_sizes : {false, true}) {
      expect_agreement(stand_of_copies({plot, 12, of_all_sizes, 3}, true), 40'000, 2'000);
    }
  }
}

TEST_F(DeviceAgreement, OnALoneMaizePlant) {
  const Mesh plant = make_maize({1, 1, 0.6, 0.6, 5});
  expect_agreement(black_model(plant, {0.6, 0.6, false}, beijing_sun()), 60'000, 1'000);
}

TEST_F(DeviceAgreement, OnRandomLeaves) {
  const Mesh leaves = random_leaves(300, 0.1, 1);
  for (const SunPosition& sun : {sun_at(90, 0), sun_at(53, 120), sun_at(10, 250)}) {
    expect_agreement(black_model(leaves, unit_plot, sun), 20'000, 4'000);
  }
  expect_agreement(black_model(leaves, unit_stand, sun_at(25, 310)), 20'000, 4'000);
}

TEST_F(DeviceAgreement, WithoutSoil) {
  const Mesh leaves = random_leaves(60, 0.1, 2);
  expect_agreement(without_soil(black_model(leaves, unit_plot, beijing_sun())), 20'000, 4'000);
  expect_agreement(without_soil(black_model(leaves, unit_stand, beijing_sun())), 20'000, 4'000);
}

TEST_F(DeviceAgreement, WithoutElements) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const RadiationModel empty = black_model({}, plot, beijing_sun());
    expect_agreement(empty, 5'000, 5'000);
    expect_agreement(without_soil(empty), 5'000, 5'000);
  }
}

TEST_F(DeviceAgreement, WithAZenithSunOverAGriddedPlate) {
  expect_agreement(black_model(gridded_plate(16), unit_plot, sun_at(90, 0)), 20'000, 4'000);
  expect_agreement(black_model(gridded_plate(16), unit_stand, sun_at(90, 0)), 20'000, 4'000);
}

TEST_F(DeviceAgreement, WithSunsAlongTheAxes) {
  const Mesh plate = gridded_plate(8);
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
    expect_agreement(black_model(plate, unit_plot, sun_at(20, azimuth)), 10'000, 2'000);
    expect_agreement(black_model(plate, unit_stand, sun_at(45, azimuth)), 10'000, 2'000);
  }
}

TEST_F(DeviceAgreement, OnALeafLargerThanThePlot) {
  MeshMaker maker;
  maker.triangle({-1.3, 0.2, -0.4}, {2.1, 0.9, 0.3}, {0.2, 0.5, 3.7});
  maker.triangle({-2.0, 1.5, 0.5}, {4.0, 1.6, 0.5}, {-2.0, 1.4, 0.55});
  for (const SunPosition& sun : {sun_at(70, 10), sun_at(15, 200)}) {
    expect_agreement(black_model(maker.mesh(), unit_plot, sun), 20'000, 5'000);
  }
}

TEST_F(DeviceAgreement, OnDuplicatesAndCoplanarLeaves) {
  for (const SunPosition& sun : {sun_at(90, 0), sun_at(40, 77)}) {
    expect_agreement(black_model(coplanar_leaves(), unit_plot, sun), 20'000, 5'000);
  }
}

// A period of 5 cm lies below a leaf 12 m high: a ray passes more than 30,000 periods on the way to the ground, so every ray
// pauses between dispatches.
TEST_F(DeviceAgreement, WithALowSunOverATinyPlot) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 12.0);
  maker.level(0.01, 0.04, 0.01, 0.04, 0.01);
  expect_agreement(black_model(maker.mesh(), {0.05, 0.05, true}, sun_at(0.5, 33)), 300, 30);
}

// Here neighbouring rays do their steps in different periods, so a group of them takes more steps than each single ray.
TEST_F(DeviceAgreement, WithALowSunThroughSlivers) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 12.0);
  add_slivers(maker, 60, 0.05, 6.0, 1e-7, 4);
  for (int stalk = 0; stalk < 40; ++stalk) {
    const double x = 0.05 * std::fmod(0.618034 * stalk, 1.0);
    const double z = 0.05 * std::fmod(0.754878 * stalk, 1.0);
    maker.triangle({x, 0.0, z}, {x + 0.004, 11.0, z + 0.004}, {x + 0.004 + 1e-7, 11.0, z + 0.004});
  }
  expect_agreement(black_model(maker.mesh(), {0.05, 0.05, true}, sun_at(0.5, 33)), 150, 0);
}

TEST_F(DeviceAgreement, OnAPileTooHighForOneDispatch) {
  MeshMaker maker;
  add_pile(maker, 70'000, 1.0, 0.5);
  expect_agreement(black_model(maker.mesh(), unit_plot, sun_at(60, 30)), 200, 60);
  expect_agreement(black_model(maker.mesh(), unit_stand, sun_at(60, 30)), 200, 60);
}

TEST_F(DeviceAgreement, OnAPileThatNeighboursWalkDifferently) {
  MeshMaker maker;
  add_slivers(maker, 150'000, 1.0, 0.5, 1e-6, 8);
  expect_agreement(black_model(maker.mesh(), unit_plot, sun_at(90, 0)), 200, 0);
}

// A ray first passes thousands of periods, then the pile: the steps of both count together.
TEST_F(DeviceAgreement, OnAPileBelowATallGap) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 6.0);
  add_pile(maker, 70'000, 0.05, 0.01);
  expect_agreement(black_model(maker.mesh(), {0.05, 0.05, true}, sun_at(0.5, 33)), 150, 0);
}

shared::ViewBlock view_of(const RadiationModel& model, const CounterLayout& layout, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 forward = glm::normalize(to - from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.01, 1.0, 0.0)));
  shared::ViewBlock view{};
  view.position = from;
  view.forward = forward;
  view.right = 0.5 * right;
  view.up = 0.375 * glm::cross(right, forward);
  view.width = 160;
  view.height = 120;
  view.samples = 3;
  view.elements = static_cast<std::uint32_t>(model.canopy.size());
  view.ground = make_ground_map(layout);
  return view;
}

class ViewAgreement : public DeviceAgreement {
 protected:
  void expect_same_picture(const RadiationModel& model, glm::dvec3 from, glm::dvec3 to) const {
    const Prepared prepared(model);
    const shared::ViewBlock view = view_of(model, prepared.layout, from, to);
    const std::vector<glm::vec2> offsets = sample_offsets(3);
    const std::vector<shared::SeenSurface> expected = view_with_cpu(prepared.bvh, {view, offsets, {}})->see(0, view.height, {});
    ASSERT_EQ(expected.size(), 160U * 120U * 3U);
    for (const BufferUse use : {BufferUse::uniform_texel, BufferUse::storage}) {
      const GpuTree tree(context(), prepared.bvh, use);
      const std::vector<shared::SeenSurface> seen =
          view_with_gpu(context(), tree, prepared.bvh, {view, offsets, {}})->see(0, view.height, {});
      ASSERT_EQ(seen.size(), expected.size());
      std::size_t apart = 0;
      for (std::size_t k = 0; k < seen.size(); ++k) apart += std::memcmp(&seen[k], &expected[k], sizeof seen[k]) == 0 ? 0 : 1;
      EXPECT_EQ(apart, 0U);
    }
  }
};

TEST_F(ViewAgreement, OfAMaizePlot) {
  const RadiationModel model = maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun());
  expect_same_picture(model, {3.0, 2.5, 2.0}, {0.6, 0.9, 0.3});
  expect_same_picture(model, {0.6, 6.0, 0.3}, {0.6, 0.0, 0.3});
  expect_same_picture(without_soil(model), {-2.0, 0.5, -2.0}, {0.6, 1.5, 0.3});
}

TEST_F(ViewAgreement, OfAPlateAlongTheAxes) {
  const RadiationModel model = black_model(gridded_plate(8), unit_stand, beijing_sun());
  expect_same_picture(model, {0.5, 3.0, 0.5}, {0.5, 0.0, 0.5});
  expect_same_picture(model, {-2.0, 0.5, 0.5}, {0.0, 0.5, 0.5});
}

TEST_F(ViewAgreement, OfAPileTooHighForOneDispatch) {
  MeshMaker maker;
  add_pile(maker, 70'000, 1.0, 0.5);
  expect_same_picture(black_model(maker.mesh(), unit_stand, beijing_sun()), {9.0, 20.0, 9.0}, {0.5, 0.0, 0.5});
}

}  // namespace
}  // namespace sunfleck::test

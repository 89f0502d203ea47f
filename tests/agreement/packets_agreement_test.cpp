// Tests that packets land on the same places on the CPU path and on the device, bit by bit, however the work is cut, so that
// whole runs with scattered light give the same numbers on both.

#include "agreement/scenes.h"
#include "devices/tracers/vulkan_tracer.h"
#include "support/copies.h"
#include "support/device.h"
#include "support/landings.h"
#include "support/leaf_scenes.h"
#include "support/processor_kinds.h"
#include "support/result_numbers.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck::test {
namespace {

// Returns packets from random points on the elements, on the ground and between them, in all directions; every fourth is nearly
// level, with a slope of about `least_slope`.
std::vector<shared::Packet> random_packets(const RadiationModel& model, const Prepared& prepared, std::size_t count,
                                           double least_slope) {
  const shared::PacketBlock scene = make_packet_block(model, prepared.layout);
  const glm::dvec3 lo = prepared.layout.box.lo_m;
  const glm::dvec3 hi = prepared.layout.box.hi_m;
  Random random(17);
  std::vector<shared::Packet> packets;
  while (packets.size() < count) {
    const double sign = packets.size() % 8 == 0 ? -1.0 : 1.0;
    const double slope = packets.size() % 4 == 0 ? sign * random.uniform(0.5, 2.0) * least_slope : random.uniform(-1.0, 1.0);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double level = std::sqrt(1.0 - slope * slope);
    const glm::vec3 direction(level * std::cos(angle), slope, level * std::sin(angle));
    const glm::dvec3 anywhere_m(random.uniform(lo.x, hi.x), random.uniform(lo.y, hi.y), random.uniform(lo.z, hi.z));
    shared::Packet packet{glm::vec3(anywhere_m), shared::no_element, direction, 0};
    if (packets.size() % 8 == 1) {
      packet.origin.y = scene.ground.y;
      packet.direction.y = std::abs(packet.direction.y);
    } else if (!prepared.bvh.copies.empty() && packets.size() % 8 != 5) {
      packet.element = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(model.canopy.size()));
      const Triangle corners = model.canopy.corners[packet.element];
      packet.origin = corners[0] + static_cast<float>(random.uniform(0.0, 0.5)) * (corners[1] - corners[0]) +
                      static_cast<float>(random.uniform(0.0, 0.5)) * (corners[2] - corners[0]);
      if (model.plot.periodic) {
        const glm::vec2 periods(std::floor(packet.origin.x / scene.period.x), std::floor(packet.origin.z / scene.period.y));
        packet.origin -= glm::vec3(periods.x * scene.period.x, 0.0F, periods.y * scene.period.y);
        packet.image = pack_image(-static_cast<int>(periods.x), -static_cast<int>(periods.y));
      }
    } else if (!prepared.bvh.triangles.empty() && packets.size() % 8 != 5) {
      const auto triangle = static_cast<std::size_t>(random.uniform() * static_cast<double>(prepared.bvh.triangles.size()));
      const BvhTriangle& start = prepared.bvh.triangles[triangle];
      const auto b = static_cast<float>(random.uniform(0.0, 0.5));
      const auto c = static_cast<float>(random.uniform(0.0, 0.5));
      for (int axis = 0; axis < 3; ++axis) {
        packet.origin[axis] = start.a[axis] + b * (start.b[axis] - start.a[axis]) + c * (start.c[axis] - start.a[axis]);
      }
      packet.element = start.element;
      packet.image = start.image;
    }
    if (model.plot.periodic) {
      packet.origin.x = std::clamp(packet.origin.x, 0.0F, scene.period.x);
      packet.origin.z = std::clamp(packet.origin.z, 0.0F, scene.period.y);
    }
    packets.push_back(packet);
  }
  return packets;
}

class PacketsAgreement : public DeviceTest {
 protected:
  // Also traces `doubted` packets by testing every element.
  void expect_agreement(const RadiationModel& model, std::size_t count, std::size_t doubted, double least_slope = 1e-5) const {
    const Prepared prepared(model);
    const shared::PacketBlock scene = make_packet_block(model, prepared.layout);
    const std::vector<shared::Packet> packets = random_packets(model, prepared, count, least_slope);
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    const Landings expected = follow(cpu, scene, packets);
    std::size_t on_elements = 0;
    for (const shared::Landing& landing : expected) {
      on_elements += landing.surface < shared::landed_on_ground ? 1 : 0;
      EXPECT_NE(landing.surface, shared::lost_on_its_way);
    }
    EXPECT_EQ(on_elements > 0, model.canopy.size() > 0);
    for (const BufferUse use : {BufferUse::uniform_texel, BufferUse::storage}) {
      const GpuTree tree(context(), prepared.bvh, use);
      VulkanTracer whole(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
      EXPECT_EQ(landings_apart(follow(whole, scene, packets), expected), 0U);
      for (const VulkanChoices cut : {VulkanChoices{64, 32}, VulkanChoices{1000, 128}}) {
        VulkanTracer tracer(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words(), cut);
        EXPECT_EQ(landings_apart(follow(tracer, scene, packets), expected), 0U) << "in dispatches of " << cut.rays_per_dispatch;
      }
    }
    const std::vector<shared::Packet> few(packets.begin(), packets.begin() + static_cast<std::ptrdiff_t>(doubted));
    CpuTracer doubter(prepared.bvh, tracer_scene(model), CpuWalk::every_element);
    EXPECT_EQ(landings_apart(follow(doubter, scene, few),
                             Landings(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(doubted))),
              0U);
  }

  void expect_same_run(const RadiationModel& model, const SolveSettings& settings) const {
    const Prepared prepared(model);
    const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
    VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    const auto theirs = all_numbers(solve(model, prepared.layout, device, settings, {}));
    const RadiationResult result = solve(model, prepared.layout, cpu, settings, {});
    EXPECT_GT(result.indirect.packets, 0U);
    EXPECT_TRUE(theirs == all_numbers(result));
  }
};

TEST_F(PacketsAgreement, OnRandomLeaves) {
  const Mesh leaves = random_leaves(300, 0.1, 1);
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const RadiationModel model = black_model(leaves, plot, beijing_sun());
    expect_agreement(model, 8'000, 1'000);
    expect_agreement(without_soil(model), 8'000, 1'000);
  }
}

TEST_F(PacketsAgreement, OnTwoMaizePlants) {
  expect_agreement(maize_model({1, 2, 0.6, 0.6, 3}, beijing_sun()), 8'000, 200);
}

TEST_F(PacketsAgreement, OnCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand, Plot{0.3, 0.7, true}}) {
    for (const bool of_all_sizes : {false, true}) {
      expect_agreement(stand_of_copies({plot, 12, of_all_sizes, 2}, true), 8'000, 1'000);
    }
  }
}

TEST_F(PacketsAgreement, OnCopiesInPieces) {
  expect_agreement(stand_of_copies({unit_plot, 8, true, 2, 300}, true), 8'000, 500);
}

TEST_F(PacketsAgreement, OfWholeRunsOnCopiesThatShareATree) {
  for (const Plot& plot : {unit_plot, unit_stand}) {
    RadiationModel model = stand_of_copies({plot, 10, true, 4}, true);
    expect_same_run(model, fixed_scatter(model, {.rays = 2e4, .packets = 500, .replicates = 4}));
    shine_from_sky(model, {});
    expect_same_run(model, fixed_scatter(model, {.rays = 2e4, .packets = 500, .replicates = 4}));
  }
}

TEST_F(PacketsAgreement, OnALeafLargerThanThePlot) {
  MeshMaker maker;
  maker.triangle({-1.3, 0.2, -0.4}, {2.1, 0.9, 0.3}, {0.2, 0.5, 3.7});
  maker.triangle({-2.0, 1.5, 0.5}, {4.0, 1.6, 0.5}, {-2.0, 1.4, 0.55});
  expect_agreement(black_model(maker.mesh(), unit_plot, beijing_sun()), 4'000, 2'000);
}

TEST_F(PacketsAgreement, OnDuplicatesCoplanarAndGriddedLeaves) {
  expect_agreement(black_model(coplanar_leaves(), unit_plot, beijing_sun()), 4'000, 2'000, 1e-3);
  expect_agreement(black_model(gridded_plate(16), unit_plot, beijing_sun()), 4'000, 2'000, 1e-3);
  expect_agreement(black_model(gridded_plate(16), unit_stand, beijing_sun()), 4'000, 2'000);
}

TEST_F(PacketsAgreement, WithoutElements) {
  for (const Plot& plot : {unit_plot, unit_stand}) expect_agreement(black_model({}, plot, beijing_sun()), 1'000, 1'000, 1e-3);
}

// A period of 5 cm lies below a leaf 12 m high: level packets pass thousands of periods and pause between dispatches.
TEST_F(PacketsAgreement, OverATinyPlot) {
  MeshMaker maker;
  maker.level(0.01, 0.02, 0.01, 0.02, 12.0);
  maker.level(0.01, 0.04, 0.01, 0.04, 0.01);
  expect_agreement(black_model(maker.mesh(), {0.05, 0.05, true}, beijing_sun()), 300, 100, 0.01);
}

TEST_F(PacketsAgreement, OfWholeRunsInTwoBands) {
  const Mesh leaves = random_leaves(100, 0.12, 5);
  SolveSettings automatic;
  automatic.accuracy.direct = 0.02;
  automatic.accuracy.indirect = 0.05;
  for (const Plot& plot : {unit_plot, unit_stand}) {
    const RadiationModel model = paper_model(leaves, plot, beijing_sun());
    SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8, .bound = 0.01});
    fixed.element_errors = ElementErrors::keep;
    expect_same_run(model, fixed);
    fixed.element_errors = ElementErrors::refine;
    expect_same_run(model, fixed);
    expect_same_run(without_soil(model), fixed);
    expect_same_run(model, automatic);
  }
}

// Each round of packets is one submission, and so are the rays whose landings packets start from; a beam's counters come back
// in a second one.
TEST_F(PacketsAgreement, TakeOneSubmissionARound) {
  const RadiationModel model = paper_model(random_leaves(100, 0.12, 5), unit_plot, beijing_sun());
  const Prepared prepared(model);
  const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
  VulkanChoices on_host;
  on_host.rounds_at = RoundsAt::host;
  VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words(), on_host);
  const DeviceTraffic before = context().traffic();
  const SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8, .bound = 0.01});
  const RadiationResult result = solve(model, prepared.layout, device, fixed, {});
  EXPECT_EQ(context().traffic().submissions - before.submissions, 3 * result.direct.replicates + result.indirect.rounds);
}

TEST_F(PacketsAgreement, OfAWholeRunWithLightAimedAtAStand) {
  RadiationModel model = paper_model(random_leaves(20, 0.02, 5), {9.0, 8.0, false}, beijing_sun());
  model.sky = SkyModel{};
  for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.4;
  SolveSettings settings;
  settings.accuracy.direct = 0.05;
  settings.accuracy.indirect = 0.1;
  settings.element_errors = ElementErrors::refine;
  expect_same_run(model, settings);
  expect_same_run(without_soil(model), settings);
}

// Beam, packets, sky light and the points of the triangles' refinement, in vectors of every width.
TEST(ProcessorsAgreement, OfWholeRuns) {
  RadiationModel of_copies = stand_of_copies({unit_plot, 10, true, 4}, true);
  shine_from_sky(of_copies, {});
  for (const RadiationModel& model : {paper_model(random_leaves(100, 0.12, 5), unit_plot, beijing_sun()), of_copies}) {
    const Prepared prepared(model);
    SolveSettings settings = fixed_scatter(model, {.rays = 2e4, .packets = 1000, .replicates = 4});
    settings.element_errors = ElementErrors::refine;
    const auto run = [&] {
      CpuTracer tracer(prepared.bvh, tracer_scene(model));
      return all_numbers(solve(model, prepared.layout, tracer, settings, {}));
    };
    const auto expected = run();
    for_each_processor_kind([&] { EXPECT_TRUE(run() == expected); });
  }
}

TEST_F(PacketsAgreement, OfWholeRunsUnderTheSkyWithReceivers) {
  const Mesh leaves = random_leaves(100, 0.12, 5);
  for (const Plot& plot : {unit_plot, unit_stand}) {
    RadiationModel model = paper_model(leaves, plot, beijing_sun());
    model.sky = SkyModel{.kind = SkyKind::overcast};
    for (Waveband& band : model.bands) band.diffuse_w_m2 = 0.4;
    model.planes = {{0.3, 20, 20}, {0.6, 7, 5}};
    const SolveSettings fixed = fixed_scatter(model, {.rays = 4e4, .packets = 2000, .replicates = 8, .bound = 0.01});
    expect_same_run(model, fixed);
    expect_same_run(without_soil(model), fixed);
    model.sun.reset();
    for (Waveband& band : model.bands) band.direct_w_m2 = 0.0;
    expect_same_run(model, fixed);
  }
}

}  // namespace
}  // namespace sunfleck::test

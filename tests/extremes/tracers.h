#pragma once
// Runs simulations and packets on every path: the tree and the test of every element on the CPU, both kinds of tree on the
// device. All must agree bit by bit.

#include "devices/tracers/vulkan_tracer.h"
#include "physics/transport/indirect/indirect.h"
#include "support/device.h"
#include "support/models.h"
#include "support/result_numbers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace sunfleck::test {

class EveryTracer : public DeviceTest {
 protected:
  // Returns where the packets land.
  [[nodiscard]] std::vector<shared::Landing> follow(const RadiationModel& model,
                                                    const std::vector<shared::Packet>& packets) const {
    const Prepared prepared(model);
    const shared::PacketBlock scene = make_packet_block(model, prepared.layout);
    CpuTracer cpu(prepared.bvh, tracer_scene(model));
    std::vector<shared::Landing> expected = landings_of(cpu, scene, packets);
    CpuTracer doubter(prepared.bvh, tracer_scene(model), CpuWalk::every_element);
    expect_same(landings_of(doubter, scene, packets), expected, "every element tested");
    for (const BufferUse use : {BufferUse::uniform_texel, BufferUse::storage}) {
      const GpuTree tree(context(), prepared.bvh, use);
      VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
      expect_same(landings_of(device, scene, packets), expected, "device");
    }
    return expected;
  }

  // Returns the result of a run whose ledgers are closed and which lost no ray.
  RadiationResult run(const RadiationModel& model, const SolveSettings& settings) const {
    const Prepared prepared(model);
    RadiationResult result = test::simulate(model, prepared, settings);
    const GpuTree tree(context(), prepared.bvh, preferred_use(context(), prepared.bvh));
    VulkanTracer device(context(), prepared.bvh, tree, tracer_scene(model), prepared.layout.words());
    EXPECT_TRUE(all_numbers(solve(model, prepared.layout, device, settings, {})) == all_numbers(result));
    EXPECT_EQ(result.lost_rays, 0U);
    for (const BandResult& band : result.bands) EXPECT_EQ(band.ledger.residual(), 0) << band.name;
    return result;
  }

 private:
  static std::vector<shared::Landing> landings_of(Tracer& tracer, const shared::PacketBlock& scene,
                                                  const std::vector<shared::Packet>& packets) {
    std::vector<shared::Landing> landings(packets.size());
    EXPECT_TRUE(tracer.trace(scene, packets, landings, {}) == TraceOutcome::finished);
    return landings;
  }
  static void expect_same(const std::vector<shared::Landing>& got, const std::vector<shared::Landing>& expected,
                          const char* path) {
    std::size_t apart = 0;
    for (std::size_t k = 0; k < got.size(); ++k) apart += std::memcmp(&got[k], &expected[k], sizeof got[k]) == 0 ? 0 : 1;
    EXPECT_EQ(apart, 0U) << path;
  }
};

}  // namespace sunfleck::test

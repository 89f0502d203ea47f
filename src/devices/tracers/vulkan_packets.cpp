#include "devices/tracers/vulkan_packets.h"

#include "base/check.h"
#include "devices/tracers/packet_order.h"
#include "packets.spirv.h"
#include "packets_storage.spirv.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(offsetof(shared::PacketBlock, ground) == 16);
static_assert(sizeof(shared::PacketBlock) == 60);
static_assert(sizeof(shared::Packet) == 32);
static_assert(sizeof(shared::Landing) == 16);
static_assert(sizeof(shared::PacketPush) == 12);
static_assert(sizeof(shared::PausedPacket) == 28);

}  // namespace

WorkShader packets_shader() {
  return {"packets", packets_spirv, packets_storage_spirv, 4};
}

VulkanPackets::VulkanPackets(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                             const VulkanChoices& choices)
    : context_(context),
      cpu_(cpu),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      packets_(create_buffer(context, BufferUse::storage, choices.rays_per_dispatch * sizeof(shared::Packet), "packets")),
      landings_(create_buffer(context, BufferUse::storage, choices.rays_per_dispatch * sizeof(shared::Landing), "landings")),
      order_(create_buffer(context, BufferUse::storage, (1 + std::size_t{choices.rays_per_dispatch}) * sizeof(std::uint32_t),
                           "the order of packets")),
      work_(context, tree, domain, choices, packets_shader(), "paused packets") {}

TraceOutcome VulkanPackets::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                  std::span<shared::Landing> landings, const StopQuestion& stop) {
  EXPECT(landings.size(), ==, packets.size());
  for (std::size_t first = 0; first < packets.size();) {
    const auto slice = packets.subspan(first, std::min<std::size_t>(work_.rays_per_dispatch(), packets.size() - first));
    const std::vector<std::uint32_t> order = order_by_direction(slice);
    const shared::PacketPush push{0, static_cast<std::uint32_t>(slice.size()), 0};
    const std::span<shared::Landing> landed = landings.subspan(first, slice.size());
    const auto send = [&](Submission& submission) {
      submission.upload(scene_, bytes_of(scene));
      submission.upload(packets_, std::as_bytes(slice));
      submission.upload(order_, bytes_of(push.count));
      submission.upload(order_, std::as_bytes(std::span(order)), sizeof(push.count));
    };
    const auto take = [&](Submission& submission, const GpuBuffer&) {
      submission.download(landings_, std::as_writable_bytes(landed));
    };
    std::vector<std::pair<std::uint32_t, shared::Landing>> finished_on_cpu;
    const auto finish = [&](const shared::PausedPacket& paused) {
      finished_on_cpu.emplace_back(paused.packet, cpu_.finish_packet(scene, slice[paused.packet], paused));
    };
    if (work_.run(push, {&scene_, &packets_, &landings_, &order_}, stop, send, take, finish) == TraceOutcome::stopped) {
      return TraceOutcome::stopped;
    }
    for (const auto& [packet, landing] : finished_on_cpu) landed[packet] = landing;
    first += slice.size();
  }
  return TraceOutcome::finished;
}

}  // namespace sunfleck

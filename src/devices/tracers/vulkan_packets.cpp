#include "devices/tracers/vulkan_packets.h"

#include "base/check.h"
#include "base/in_blocks.h"
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

// The device is idle while packets are being ordered.
constexpr std::size_t packets_per_block = 8192;

}  // namespace

VulkanPackets::VulkanPackets(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                             const VulkanChoices& choices)
    : context_(context),
      cpu_(cpu),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      packets_(create_buffer(context, BufferUse::storage, choices.rays_per_dispatch * sizeof(shared::Packet), "packets")),
      landings_(create_buffer(context, BufferUse::storage, choices.rays_per_dispatch * sizeof(shared::Landing), "landings")),
      work_(context, tree, domain, choices, {"packets", packets_spirv, packets_storage_spirv, 3}, "paused packets") {}

TraceOutcome VulkanPackets::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                  std::span<shared::Landing> landings, const StopQuestion& stop) {
  EXPECT(landings.size(), ==, packets.size());
  for (std::size_t first = 0; first < packets.size();) {
    const auto slice = packets.subspan(first, std::min<std::size_t>(work_.rays_per_dispatch(), packets.size() - first));
    const std::vector<std::uint32_t> order = order_by_direction(slice);
    sent_.resize(slice.size());
    each_in_blocks(order.size(), packets_per_block, [&](std::size_t k) { sent_[k] = slice[order[k]]; });
    landed_.resize(sent_.size());
    const auto send = [&](Submission& submission) {
      submission.upload(scene_, std::as_bytes(std::span(&scene, 1)));
      submission.upload(packets_, std::as_bytes(std::span(sent_)));
    };
    const auto take = [&](Submission& submission) {
      submission.download(landings_, std::as_writable_bytes(std::span(landed_)));
    };
    std::vector<std::pair<std::uint32_t, shared::Landing>> finished_on_cpu;
    const auto finish = [&](const shared::PausedPacket& paused) {
      shared::Packet packet = sent_[paused.packet];
      packet.origin = paused.origin;
      packet.image = paused.image;
      finished_on_cpu.emplace_back(paused.packet, cpu_.follow_packet(scene, packet, paused.crossings));
    };
    const auto count = static_cast<std::uint32_t>(sent_.size());
    if (work_.run({0, count, 0}, {&scene_, &packets_, &landings_}, stop, send, take, finish) == TraceOutcome::stopped)
      return TraceOutcome::stopped;
    for (const auto& [packet, landing] : finished_on_cpu) landed_[packet] = landing;
    each_in_blocks(order.size(), packets_per_block, [&](std::size_t k) { landings[first + order[k]] = landed_[k]; });
    first += slice.size();
  }
  return TraceOutcome::finished;
}

}  // namespace sunfleck

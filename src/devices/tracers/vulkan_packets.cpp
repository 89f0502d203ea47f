#include "devices/tracers/vulkan_packets.h"

#include "base/check.h"
#include "devices/tracers/packet_order.h"
#include "packets.spirv.h"
#include "packets_storage.spirv.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

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

constexpr std::size_t outbox_head_bytes = sizeof(std::uint32_t);

ShaderCode packets_shader(const GpuTree& tree, std::uint32_t group_size) {
  const std::span<const std::uint32_t> spirv = tree.fetch == TreeFetch::texel_buffers
                                                   ? std::span<const std::uint32_t>(packets_spirv)
                                                   : std::span<const std::uint32_t>(packets_storage_spirv);
  std::vector<BufferUse> bindings{tree.use(), tree.use()};
  bindings.resize(7, BufferUse::storage);
  return {"packets", spirv, bindings, sizeof(shared::PacketPush), group_size};
}

// Uses all cores, because the device is idle while packets are being ordered.
template <class Action>
void for_each_index(std::size_t count, const Action& action) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 8192), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) action(k);
  });
}

}  // namespace

VulkanPackets::VulkanPackets(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                             const VulkanChoices& choices)
    : context_(context),
      tree_(tree),
      cpu_(cpu),
      packets_per_dispatch_(choices.rays_per_dispatch),
      budget_(choices.rays_per_dispatch, choices.seconds_per_dispatch),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      packets_(create_buffer(context, BufferUse::storage, packets_per_dispatch_ * sizeof(shared::Packet), "packets")),
      landings_(create_buffer(context, BufferUse::storage, packets_per_dispatch_ * sizeof(shared::Landing), "landings")),
      inbox_(create_buffer(context, BufferUse::storage,
                           outbox_head_bytes + packets_per_dispatch_ * sizeof(shared::PausedPacket), "paused packets")),
      outbox_(create_buffer(context, BufferUse::storage, inbox_.bytes, "paused packets")),
      pipeline_(context, packets_shader(tree, choices.group_size),
                {domain.periodic ? 1U : 0U, domain.has_soil ? 1U : 0U, choices.group_size}) {}

void VulkanPackets::dispatch(const shared::PacketPush& push) {
  const std::uint32_t none = 0;
  upload(context_, outbox_, std::as_bytes(std::span(&none, 1)));
  const GpuBuffer* const buffers[] = {&tree_.nodes, &tree_.triangles, &scene_, &packets_, &landings_, &inbox_, &outbox_};
  pipeline_.run(push.count, std::as_bytes(std::span(&push, 1)), buffers);
}

std::uint32_t VulkanPackets::take_out_stuck(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                            std::vector<std::pair<std::uint32_t, shared::Landing>>& finished) {
  std::uint32_t count = 0;
  download(context_, outbox_, std::as_writable_bytes(std::span(&count, 1)));
  if (count == 0) return 0;
  std::vector<shared::PausedPacket> paused(count);
  download(context_, outbox_, std::as_writable_bytes(std::span(paused)), outbox_head_bytes);
  const auto stuck =
      std::partition(paused.begin(), paused.end(), [](const shared::PausedPacket& packet) { return packet.stuck == 0; });
  if (stuck == paused.end()) return count;
  for (auto each = stuck; each != paused.end(); ++each) {
    shared::Packet packet = packets[each->packet];
    packet.origin = each->origin;
    packet.image = each->image;
    finished.emplace_back(each->packet, cpu_.follow_packet(scene, packet, each->crossings));
  }
  paused.erase(stuck, paused.end());
  upload(context_, outbox_, std::as_bytes(std::span(paused)), outbox_head_bytes);
  return static_cast<std::uint32_t>(paused.size());
}

TraceOutcome VulkanPackets::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                  std::span<shared::Landing> landings, const StopQuestion& stop) {
  EXPECT(landings.size(), ==, packets.size());
  upload(context_, scene_, std::as_bytes(std::span(&scene, 1)));
  for (std::size_t first = 0; first < packets.size();) {
    const auto slice = packets.subspan(first, std::min<std::size_t>(budget_.rays(), packets.size() - first));
    const std::vector<std::uint32_t> order = order_by_direction(slice);
    sent_.resize(slice.size());
    for_each_index(order.size(), [&](std::size_t k) { sent_[k] = slice[order[k]]; });
    upload(context_, packets_, std::as_bytes(std::span(sent_)));
    std::vector<std::pair<std::uint32_t, shared::Landing>> finished_on_cpu;
    shared::PacketPush push{0, static_cast<std::uint32_t>(sent_.size()), 0};
    while (push.count > 0) {
      if (stop && stop()) return TraceOutcome::stopped;
      const DispatchClock clock;
      dispatch(push);
      budget_.record_duration(push.count, clock.seconds());
      push = {0, take_out_stuck(scene, sent_, finished_on_cpu), 1};
      std::swap(inbox_, outbox_);
    }
    landed_.resize(sent_.size());
    download(context_, landings_, std::as_writable_bytes(std::span(landed_)));
    for (const auto& [packet, landing] : finished_on_cpu) landed_[packet] = landing;
    for_each_index(order.size(), [&](std::size_t k) { landings[first + order[k]] = landed_[k]; });
    first += slice.size();
  }
  return TraceOutcome::finished;
}

}  // namespace sunfleck

#include "devices/tracers/vulkan_rounds.h"

#include "base/check.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/vulkan_packets.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sunfleck {

VulkanRounds::VulkanRounds(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                           const VulkanChoices& choices)
    : context_(context),
      cpu_(cpu),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      steps_(context, choices.rounds, choices.rays_per_dispatch),
      work_(context, tree, domain, choices, packets_shader(), "paused packets") {}

std::optional<TraceOutcome> VulkanRounds::make(const RoundsOrder& order, RoundsSums& sums, const StopQuestion& stop) {
  if (!steps_.take(order)) return std::nullopt;
  upload(context_, scene_, std::as_bytes(std::span(&order.scene.block, 1)));
  auto places = static_cast<std::uint32_t>(order.places.size());
  for (shared::RoundState state = draw(places); state.done == 0; state = draw(places)) {
    ENSURE(state.packets, <=, steps_.sizes().packets);
    if (send(order.scene.block, places, state.packets, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
    sums.packets += state.packets;
    places = state.packets;
  }
  steps_.fetch(sums);
  return TraceOutcome::finished;
}

shared::RoundState VulkanRounds::draw(std::uint32_t places) {
  shared::RoundState state{};
  Submission submission(context_);
  steps_.begin(submission);
  steps_.sort(submission, places);
  steps_.draw(submission, places);
  steps_.fetch(submission, state);
  submission.finish();
  return state;
}

TraceOutcome VulkanRounds::send(const shared::PacketBlock& scene, std::uint32_t places, std::uint32_t packets,
                                const StopQuestion& stop) {
  if (packets == 0) {  // all columns are retired
    Submission submission(context_);
    steps_.weigh(submission, places, packets);
    submission.finish();
  }
  for (std::uint32_t first = 0; first < packets;) {
    const shared::RoundPush part{first, std::min(work_.rays_per_dispatch(), packets - first)};
    const auto weigh = [&](Submission& submission) {
      if (first == 0) steps_.weigh(submission, places, packets);
    };
    if (send_part(scene, part, weigh, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
    first += part.count;
  }
  return TraceOutcome::finished;
}

// Packets that are stuck are finished by the CPU, and only then are all of the part booked.
template <class Before>
TraceOutcome VulkanRounds::send_part(const shared::PacketBlock& scene, shared::RoundPush part, const Before& before,
                                     const StopQuestion& stop) {
  const GpuBuffer& packets = steps_.buffer(RoundBuffer::packets);
  const GpuBuffer& landings = steps_.buffer(RoundBuffer::landings);
  std::vector<std::pair<std::uint32_t, shared::Landing>> finished_on_cpu;
  const auto start = [&](Submission& submission) {
    before(submission);
    steps_.start(submission, part);
  };
  const auto book = [&](Submission& submission, const GpuBuffer& outbox) {
    if (finished_on_cpu.empty()) steps_.book(submission, part, outbox);
  };
  const auto finish = [&](const shared::PausedPacket& paused) {
    shared::Packet packet;
    download(context_, packets, std::as_writable_bytes(std::span(&packet, 1)), paused.packet * sizeof(packet));
    finished_on_cpu.emplace_back(paused.packet, cpu_.finish_packet(scene, packet, paused));
  };
  const std::vector<const GpuBuffer*> traced{&scene_, &packets, &landings, &steps_.buffer(RoundBuffer::order)};
  if (work_.run({0, part.count, 0}, traced, stop, start, book, finish) == TraceOutcome::stopped) return TraceOutcome::stopped;
  if (finished_on_cpu.empty()) return TraceOutcome::finished;
  Submission submission(context_);
  for (const auto& [packet, landing] : finished_on_cpu) {
    submission.upload(landings, std::as_bytes(std::span(&landing, 1)), packet * sizeof(landing));
  }
  steps_.book(submission, part);
  submission.finish();
  return TraceOutcome::finished;
}

}  // namespace sunfleck

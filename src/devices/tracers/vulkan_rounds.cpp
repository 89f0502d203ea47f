#include "devices/tracers/vulkan_rounds.h"

#include "base/check.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/vulkan_packets.h"

#include <algorithm>
#include <span>

namespace sunfleck {
namespace {

constexpr std::uint32_t first_rounds_on_hardware = 8;
// What a submission holds at most, since Ctrl-C waits for it, and drivers end what takes seconds.
constexpr std::uint32_t most_rounds_at_once = 32;
constexpr std::uint64_t most_packets_at_once = std::uint64_t{1} << 22U;

shared::RoundChoices completed(const VulkanChoices& choices) {
  constexpr std::uint32_t copies = 32;
  shared::RoundChoices rounds = choices.rounds;
  if (rounds.copies == 0) rounds.copies = copies;
  rounds.trace_group_size = choices.group_size;
  return rounds;
}

// The drawing of a window waits for a submission, so that those with a target of time must be short.
std::uint32_t at_once(const VulkanChoices& choices, bool software) {
  if (choices.seconds_per_dispatch > 0.0) return 1;
  if (choices.rounds_at_once > 0) return choices.rounds_at_once;
  return software ? 1 : first_rounds_on_hardware;
}

}  // namespace

VulkanRounds::VulkanRounds(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                           const VulkanChoices& choices)
    : context_(context),
      cpu_(cpu),
      rounds_at_once_(at_once(choices, context.description().software)),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      steps_(context, completed(choices), choices.rays_per_dispatch),
      work_(context, tree, domain, choices, packets_shader(), "paused packets") {}

std::optional<TraceOutcome> VulkanRounds::make(const RoundsOrder& order, RoundsSums& sums, const StopQuestion& stop) {
  if (!steps_.make_room(order)) return std::nullopt;
  const std::size_t packets = steps_.sizes().packets;
  const std::uint64_t rounds = std::min<std::uint64_t>(rounds_at_once_, most_packets_at_once / packets);
  const bool together = rounds > 1 && packets == steps_.sizes().packets_at_a_time && packets <= work_.max_threads();
  const TraceOutcome outcome =
      together ? make_together(order, static_cast<std::uint32_t>(rounds), stop) : make_in_parts(order, stop);
  if (outcome == TraceOutcome::finished) steps_.fetch(sums);
  return outcome;
}

void VulkanRounds::give(Submission& submission, const RoundsOrder& order) {
  steps_.give(submission, order);
  submission.upload(scene_, std::as_bytes(std::span(&order.scene.block, 1)));
}

std::vector<const GpuBuffer*> VulkanRounds::traced() const {
  return {&scene_, &steps_.buffer(RoundBuffer::packets), &steps_.buffer(RoundBuffer::landings),
          &steps_.buffer(RoundBuffer::order)};
}

TraceOutcome VulkanRounds::make_together(const RoundsOrder& order, std::uint32_t rounds, const StopQuestion& stop) {
  bool is_given = false;
  shared::RoundState state{};
  state.has_to_wait = 1;  // the first round has not begun
  while (state.done == 0) {
    if (stop && stop()) return TraceOutcome::stopped;
    Submission submission(context_);
    if (!is_given) give(submission, order);
    is_given = true;
    if (state.has_to_wait != 0) begin_with_empty_outbox(submission);
    for (std::uint32_t round = 0; round < rounds; ++round) record_round(submission);
    steps_.fetch(submission, state);
    submission.finish();
    ENSURE(state.most_drawn, <=, steps_.sizes().packets);
    if (state.has_to_wait == 0) continue;
    if (finish_round(order.scene.block, state.packets, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
  }
  constexpr std::uint32_t least = 2;
  rounds_at_once_ = std::clamp(state.rounds + 1, least, most_rounds_at_once);  // the next replicate needs about as many
  return TraceOutcome::finished;
}

void VulkanRounds::begin_with_empty_outbox(Submission& submission) {
  constexpr std::uint32_t none = 0;
  submission.upload(work_.outbox(), std::as_bytes(std::span(&none, 1)));
  steps_.set_outbox(&work_.outbox());
  steps_.begin(submission);
}

void VulkanRounds::record_round(Submission& submission) {
  steps_.sort(submission);
  steps_.draw(submission);
  steps_.weigh(submission);
  steps_.start(submission);
  work_.record(submission, {0, shared::all_packets, 0}, steps_.buffer(RoundBuffer::groups),
               RoundBuffers::offset_of_groups(shared::groups_of_traces), traced());
  steps_.book(submission);
  steps_.begin(submission);
}

// Packets that are stuck are finished by the CPU, and only then are all of them booked.
template <class Trace>
TraceOutcome VulkanRounds::bring_to_ends(const shared::PacketBlock& scene, shared::RoundPush packets, const Trace& trace) {
  Finished finished;
  const auto after = [&](Submission& submission, const GpuBuffer& outbox) {
    steps_.set_outbox(&outbox);
    if (finished.empty()) steps_.book(submission, packets);
  };
  const auto finish = [&](const shared::PausedPacket& paused) { finished.push_back(finish_on_cpu(scene, paused)); };
  if (trace(after, finish) == TraceOutcome::stopped) return TraceOutcome::stopped;
  if (!finished.empty()) book(finished, packets);
  return TraceOutcome::finished;
}

TraceOutcome VulkanRounds::finish_round(const shared::PacketBlock& scene, std::uint32_t packets, const StopQuestion& stop) {
  return bring_to_ends(scene, {0, packets},
                       [&](const auto& after, const auto& finish) { return work_.resume(traced(), stop, after, finish); });
}

TraceOutcome VulkanRounds::make_in_parts(const RoundsOrder& order, const StopQuestion& stop) {
  Submission first(context_);
  give(first, order);
  shared::RoundState state = draw(first);
  while (state.done == 0) {
    ENSURE(state.most_drawn, <=, steps_.sizes().packets);
    if (send(order.scene.block, state.packets, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
    if (stop && stop()) return TraceOutcome::stopped;
    Submission next(context_);
    state = draw(next);
  }
  return TraceOutcome::finished;
}

shared::RoundState VulkanRounds::draw(Submission& submission) {
  shared::RoundState state{};
  steps_.set_outbox(nullptr);
  steps_.begin(submission);
  steps_.sort(submission);
  steps_.draw(submission);
  steps_.fetch(submission, state);
  submission.finish();
  return state;
}

TraceOutcome VulkanRounds::send(const shared::PacketBlock& scene, std::uint32_t packets, const StopQuestion& stop) {
  if (packets == 0) {  // none carries any column, so that this retires all of them
    Submission submission(context_);
    steps_.weigh(submission);
    submission.finish();
  }
  for (std::uint32_t first = 0; first < packets;) {
    const shared::RoundPush part{first, std::min(work_.rays_per_dispatch(), packets - first)};
    const auto start = [&](Submission& submission) {
      steps_.set_outbox(nullptr);
      if (first == 0) steps_.weigh(submission);
      steps_.start(submission, part);
    };
    const auto trace = [&](const auto& after, const auto& finish) {
      return work_.run({0, part.count, 0}, traced(), stop, start, after, finish);
    };
    if (bring_to_ends(scene, part, trace) == TraceOutcome::stopped) return TraceOutcome::stopped;
    first += part.count;
  }
  return TraceOutcome::finished;
}

std::pair<std::uint32_t, shared::Landing> VulkanRounds::finish_on_cpu(const shared::PacketBlock& scene,
                                                                      const shared::PausedPacket& paused) const {
  shared::Packet packet;
  download(context_, steps_.buffer(RoundBuffer::packets), std::as_writable_bytes(std::span(&packet, 1)),
           paused.packet * sizeof(packet));
  return {paused.packet, cpu_.finish_packet(scene, packet, paused)};
}

void VulkanRounds::book(const Finished& finished, shared::RoundPush part) {
  Submission submission(context_);
  for (const auto& [packet, landing] : finished) {
    submission.upload(steps_.buffer(RoundBuffer::landings), std::as_bytes(std::span(&landing, 1)), packet * sizeof(landing));
  }
  steps_.set_outbox(nullptr);
  steps_.book(submission, part);
  submission.finish();
}

}  // namespace sunfleck

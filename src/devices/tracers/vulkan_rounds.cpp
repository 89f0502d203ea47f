#include "devices/tracers/vulkan_rounds.h"

#include "base/check.h"
#include "devices/gpu/submission.h"
#include "devices/tracers/vulkan_packets.h"

#include <algorithm>
#include <span>

namespace sunfleck {
namespace {

constexpr std::uint32_t first_rounds_on_hardware = 8;
constexpr std::uint32_t default_lanes = 16;
// What a submission holds at most, since Ctrl-C waits for it, and drivers end what takes seconds.
constexpr std::uint32_t most_rounds_at_once = 32;
constexpr std::uint64_t most_packets_at_once = std::uint64_t{1} << 24U;
constexpr std::uint32_t least_rounds_at_once = 2;

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
      most_lanes_(most_lanes(choices, context.description().software)),
      scene_(create_buffer(context, BufferUse::storage, sizeof(shared::PacketBlock), "the scene's description")),
      steps_(context, completed(choices), choices.rays_per_dispatch),
      work_(context, tree, domain, choices, packets_shader(), "paused packets") {}

std::size_t VulkanRounds::most_lanes(const VulkanChoices& choices, bool software) {
  if (at_once(choices, software) == 1) return 1;
  return choices.lanes > 0 ? choices.lanes : default_lanes;
}

std::optional<TraceOutcome> VulkanRounds::make(std::span<const RoundsPass> passes, const StopQuestion& stop) {
  while (!passes.empty()) {
    const std::size_t lanes = make_room(passes);
    if (lanes == 0) return std::nullopt;
    const std::span<const RoundsPass> next = passes.first(lanes);
    const bool together = rounds_at_once(lanes) > 1;
    const std::optional<TraceOutcome> outcome = together ? make_together(next, stop) : make_in_parts(next.front(), stop);
    if (outcome != TraceOutcome::finished) return outcome;
    steps_.fetch(next);
    passes = passes.subspan(lanes);
  }
  return TraceOutcome::finished;
}

std::size_t VulkanRounds::make_room(std::span<const RoundsPass> passes) {
  const std::uint64_t packets = passes.front().order->most_packets();
  const std::uint64_t most = rounds_at_once_ > 1 ? most_packets_at_once / (least_rounds_at_once * packets) : 1;
  const std::size_t lanes = std::clamp<std::size_t>(most, 1, std::min(most_lanes_, passes.size()));
  const std::size_t found = steps_.make_room(passes.first(lanes));
  return rounds_at_once(found) > 1 ? found : std::min<std::size_t>(found, 1);
}

std::uint32_t VulkanRounds::rounds_at_once(std::size_t lanes) const {
  const std::size_t packets = steps_.sizes().packets;
  if (packets != steps_.sizes().packets_at_a_time || packets > work_.max_threads()) return 1;
  const std::uint64_t most = most_packets_at_once / (std::max<std::size_t>(1, lanes) * packets);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(rounds_at_once_, most));
}

bool VulkanRounds::lacks_room(const RoundsPass& pass, const shared::RoundState& state) const {
  if (state.most_drawn <= steps_.sizes().packets) return false;
  ENSURE(pass.order->block.stand.radius, >, 0.0F);
  return true;
}

void VulkanRounds::give(Submission& submission, std::span<const RoundsPass> passes) {
  steps_.give(submission, passes);
  submission.upload(scene_, bytes_of(passes.front().order->scene.block));
}

std::vector<const GpuBuffer*> VulkanRounds::traced(std::size_t lane) const {
  return {&scene_, &steps_.buffer(RoundBuffer::packets, lane), &steps_.buffer(RoundBuffer::landings, lane),
          &steps_.buffer(RoundBuffer::order, lane)};
}

std::optional<TraceOutcome> VulkanRounds::make_together(std::span<const RoundsPass> passes, const StopQuestion& stop) {
  const std::uint32_t rounds = rounds_at_once(passes.size());
  std::vector<shared::RoundState> states(passes.size());
  const auto is_done = [](const shared::RoundState& state) { return state.done != 0; };
  for (bool is_first = true; is_first || !std::all_of(states.begin(), states.end(), is_done); is_first = false) {
    if (stop && stop()) return TraceOutcome::stopped;
    Submission submission(context_);
    if (is_first) {
      give(submission, passes);
      steps_.begin(submission);
    }
    for (std::size_t lane = 0; lane < passes.size(); ++lane) {
      if (states[lane].has_to_wait != 0) steps_.begin(submission, lane);
    }
    for (std::uint32_t round = 0; round < rounds; ++round) record_round(submission, passes.size());
    steps_.fetch(submission, states);
    submission.finish();
    for (std::size_t lane = 0; lane < passes.size(); ++lane) {
      if (lacks_room(passes[lane], states[lane])) return std::nullopt;
      if (states[lane].has_to_wait == 0) continue;
      const shared::PacketBlock& scene = passes[lane].order->scene.block;
      if (finish_round(scene, lane, states[lane].packets, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
    }
  }
  const auto fewer_rounds = [](const shared::RoundState& a, const shared::RoundState& b) { return a.rounds < b.rounds; };
  const std::uint32_t needed = std::max_element(states.begin(), states.end(), fewer_rounds)->rounds;
  rounds_at_once_ = std::clamp(needed + 1, least_rounds_at_once, most_rounds_at_once);  // the next ones need about as many
  return TraceOutcome::finished;
}

void VulkanRounds::record_round(Submission& submission, std::size_t lanes) {
  steps_.sort(submission);
  steps_.draw(submission);
  steps_.weigh(submission);
  steps_.start(submission);
  {
    const Submission::SideBySide side_by_side(submission);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      work_.record(submission, {0, shared::all_packets, 0}, steps_.buffer(RoundBuffer::groups, lane),
                   RoundBuffers::offset_of_groups(shared::groups_of_traces), traced(lane),
                   steps_.buffer(RoundBuffer::outbox, lane));
    }
  }
  steps_.book(submission);
  steps_.begin(submission);
}

// Packets that are stuck are finished by the CPU, and only then are all of them booked.
template <class Trace>
TraceOutcome VulkanRounds::bring_to_ends(const shared::PacketBlock& scene, std::size_t lane, shared::RoundPush packets,
                                         const Trace& trace) {
  Finished finished;
  const auto after = [&](Submission& submission, const GpuBuffer& outbox) {
    if (finished.empty()) steps_.book(submission, lane, packets, &outbox);
  };
  const auto finish = [&](const shared::PausedPacket& paused) { finished.push_back(finish_on_cpu(scene, lane, paused)); };
  if (trace(after, finish) == TraceOutcome::stopped) return TraceOutcome::stopped;
  if (!finished.empty()) book(finished, lane, packets);
  return TraceOutcome::finished;
}

TraceOutcome VulkanRounds::finish_round(const shared::PacketBlock& scene, std::size_t lane, std::uint32_t packets,
                                        const StopQuestion& stop) {
  const auto trace = [&](const auto& after, const auto& finish) {
    return work_.resume(steps_.buffer(RoundBuffer::outbox, lane), traced(lane), stop, after, finish);
  };
  return bring_to_ends(scene, lane, {0, packets}, trace);
}

std::optional<TraceOutcome> VulkanRounds::make_in_parts(const RoundsPass& pass, const StopQuestion& stop) {
  Submission first(context_);
  give(first, std::span(&pass, 1));
  shared::RoundState state = draw(first);
  while (state.done == 0) {
    if (lacks_room(pass, state)) return std::nullopt;
    if (send(pass.order->scene.block, state.packets, stop) == TraceOutcome::stopped) return TraceOutcome::stopped;
    if (stop && stop()) return TraceOutcome::stopped;
    Submission next(context_);
    state = draw(next);
  }
  return TraceOutcome::finished;
}

shared::RoundState VulkanRounds::draw(Submission& submission) {
  shared::RoundState state{};
  steps_.begin(submission);
  steps_.sort(submission);
  steps_.draw(submission);
  steps_.fetch(submission, std::span(&state, 1));
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
      if (first == 0) steps_.weigh(submission);
      steps_.start(submission, part);
    };
    const auto trace = [&](const auto& after, const auto& finish) {
      return work_.run({0, part.count, 0}, traced(0), stop, start, after, finish);
    };
    if (bring_to_ends(scene, 0, part, trace) == TraceOutcome::stopped) return TraceOutcome::stopped;
    first += part.count;
  }
  return TraceOutcome::finished;
}

std::pair<std::uint32_t, shared::Landing> VulkanRounds::finish_on_cpu(const shared::PacketBlock& scene, std::size_t lane,
                                                                      const shared::PausedPacket& paused) const {
  shared::Packet packet;
  download(context_, steps_.buffer(RoundBuffer::packets, lane), writable_bytes_of(packet), paused.packet * sizeof(packet));
  return {paused.packet, cpu_.finish_packet(scene, packet, paused)};
}

void VulkanRounds::book(const Finished& finished, std::size_t lane, shared::RoundPush part) {
  Submission submission(context_);
  for (const auto& [packet, landing] : finished) {
    submission.upload(steps_.buffer(RoundBuffer::landings, lane), bytes_of(landing), packet * sizeof(landing));
  }
  steps_.book(submission, lane, part, nullptr);
  submission.finish();
}

}  // namespace sunfleck

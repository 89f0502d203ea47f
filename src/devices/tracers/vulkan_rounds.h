#pragma once
// The part of the Vulkan tracer that makes the rounds of indirect passes on the device: packets are drawn, started, traced and
// booked there. It is created with the first beam whose landings are kept, or the first pass. A round has too little work for a
// GPU, so that several passes are made side by side.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/paused_work.h"
#include "devices/tracers/round_steps.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_choices.h"
#include "physics/transport/model/tracer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {

class VulkanRounds {
 public:
  // All arguments except the choices must outlive the object; the choices are complete, and RoundSteps work on the device.
  VulkanRounds(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
               const VulkanChoices& choices);

  // Returns how many passes are made side by side, at most.
  [[nodiscard]] static std::size_t most_lanes(const VulkanChoices& choices, bool software);

  // Returns room for the landings of a beam; see RoundSteps.
  [[nodiscard]] std::shared_ptr<const LandingsOnDevice> keep_landings(std::size_t rays) { return steps_.keep_landings(rays); }

  // Does what Tracer::make_rounds does. Returns nothing if a pass is too large for the device, or turns out to be.
  [[nodiscard]] std::optional<TraceOutcome> make(std::span<const RoundsPass> passes, const StopQuestion& stop);

 private:
  // Packets that the CPU has finished, by their numbers in the dispatch, and where they landed.
  using Finished = std::vector<std::pair<std::uint32_t, shared::Landing>>;

  // Makes room for some of the passes, and returns how many are to be made together; 0 if none has room.
  [[nodiscard]] std::size_t make_room(std::span<const RoundsPass> passes);
  // Returns whether a round has drawn more packets than there is room for. That may happen where packets are aimed at a stand, since
  // the flux of places that keep all of their expected packets may grow from round to round.
  [[nodiscard]] bool lacks_room(const RoundsPass& pass, const shared::RoundState& state) const;
  // Returns how many rounds of as many lanes a submission may hold.
  [[nodiscard]] std::uint32_t rounds_at_once(std::size_t lanes) const;

  // Makes several rounds at a time without the host, which then finishes packets that paused.
  [[nodiscard]] std::optional<TraceOutcome> make_together(std::span<const RoundsPass> passes, const StopQuestion& stop);
  // Records a round that has begun, and the beginning of the next one.
  void record_round(Submission& submission, std::size_t lanes);
  // Brings the packets that paused in the last round of a lane to their ends, and books it.
  [[nodiscard]] TraceOutcome finish_round(const shared::PacketBlock& scene, std::size_t lane, std::uint32_t packets,
                                          const StopQuestion& stop);

  // Makes one round of the only lane after the other, in dispatches that are short enough.
  [[nodiscard]] std::optional<TraceOutcome> make_in_parts(const RoundsPass& pass, const StopQuestion& stop);
  // Draws the packets of the next round.
  [[nodiscard]] shared::RoundState draw(Submission& submission);
  [[nodiscard]] TraceOutcome send(const shared::PacketBlock& scene, std::uint32_t packets, const StopQuestion& stop);

  void give(Submission& submission, std::span<const RoundsPass> passes);
  // Has packets of a lane traced by trace(after, finish), whose arguments are those of PausedWork::run, and books them.
  template <class Trace>
  [[nodiscard]] TraceOutcome bring_to_ends(const shared::PacketBlock& scene, std::size_t lane, shared::RoundPush packets,
                                           const Trace& trace);
  // Returns the landing of a packet that is stuck.
  [[nodiscard]] std::pair<std::uint32_t, shared::Landing> finish_on_cpu(const shared::PacketBlock& scene, std::size_t lane,
                                                                        const shared::PausedPacket& paused) const;
  // Books packets of which the CPU has finished some.
  void book(const Finished& finished, std::size_t lane, shared::RoundPush part);
  // Returns the buffers of the shader that follows packets.
  [[nodiscard]] std::vector<const GpuBuffer*> traced(std::size_t lane) const;

  const GpuContext& context_;
  const CpuTracer& cpu_;
  std::uint32_t rounds_at_once_;  // 1: each round in parts
  std::size_t most_lanes_;
  GpuBuffer scene_;
  RoundSteps steps_;
  PausedWork<shared::PausedPacket, shared::PacketPush> work_;
};

}  // namespace sunfleck

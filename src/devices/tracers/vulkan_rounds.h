#pragma once
// The part of the Vulkan tracer that makes the rounds of indirect passes on the device: packets are drawn, started, traced and booked
// there. The host learns only how many packets a round has, and at the end the sums. It is created for the first pass.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/paused_work.h"
#include "devices/tracers/round_steps.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_choices.h"
#include "physics/transport/indirect/device_rounds.h"
#include "physics/transport/model/tracer.h"

#include <cstdint>
#include <optional>

namespace sunfleck {

class VulkanRounds {
 public:
  // All arguments except the choices must outlive the object; the choices are complete, and RoundSteps work on the device.
  VulkanRounds(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
               const VulkanChoices& choices);

  // Does what Tracer::make_rounds does. Returns nothing if the pass is too large for the device.
  [[nodiscard]] std::optional<TraceOutcome> make(const RoundsOrder& order, RoundsSums& sums, const StopQuestion& stop);

 private:
  // Draws the packets of the next round from so many places.
  [[nodiscard]] shared::RoundState draw(std::uint32_t places);
  // Sends the packets of a round, drawn from so many places.
  [[nodiscard]] TraceOutcome send(const shared::PacketBlock& scene, std::uint32_t places, std::uint32_t packets,
                                  const StopQuestion& stop);
  // Sends some of them; before(submission) comes first.
  template <class Before>
  [[nodiscard]] TraceOutcome send_part(const shared::PacketBlock& scene, shared::RoundPush part, const Before& before,
                                       const StopQuestion& stop);

  const GpuContext& context_;
  const CpuTracer& cpu_;
  GpuBuffer scene_;
  RoundSteps steps_;
  PausedWork<shared::PausedPacket, shared::PacketPush> work_;
};

}  // namespace sunfleck

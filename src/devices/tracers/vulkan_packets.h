#pragma once
// The part of the Vulkan tracer that follows packets. It is created when the first packet is traced, so that a run without
// scattering has neither its buffers nor its shader.

#include "devices/gpu/buffer.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/paused_work.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_choices.h"
#include "physics/transport/model/tracer.h"

namespace sunfleck {

// Returns the shader that follows packets; its buffers are the scene, the packets, their landings, and their order after their
// number.
[[nodiscard]] WorkShader packets_shader();

class VulkanPackets {
 public:
  // All arguments except the choices must outlive the object; the choices are complete.
  VulkanPackets(const GpuContext& context, const GpuTree& tree, const CpuTracer& cpu, TraceDomain domain,
                const VulkanChoices& choices);

  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop);

 private:
  const GpuContext& context_;
  const CpuTracer& cpu_;
  GpuBuffer scene_, packets_, landings_, order_;
  PausedWork<shared::PausedPacket, shared::PacketPush> work_;
};

}  // namespace sunfleck

#pragma once
// The tracer on Vulkan: uploads the tree once, divides every replicate into short dispatches and resumes paused rays.

#include "devices/gpu/buffer.h"
#include "devices/gpu/context.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/gpu_tree.h"
#include "devices/tracers/paused_work.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_choices.h"
#include "devices/tracers/vulkan_packets.h"
#include "devices/tracers/vulkan_rounds.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/tracer.h"

#include <memory>
#include <vector>

namespace sunfleck {

class VulkanTracer : public Tracer {
 public:
  // Context, tree and device tree must outlive the tracer. `counter_words` is the length of the counters of every count_beam.
  // Throws Error (device) naming the limit if the counters are too large for the device, and Error (failure) if its memory runs
  // out.
  VulkanTracer(const GpuContext& context, const Bvh& bvh, const GpuTree& tree, TraceDomain domain, std::size_t counter_words,
               VulkanChoices choices = {});

  [[nodiscard]] TracerDevice device() const override;
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override;
  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override;
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::size_t most_passes() const override;
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override;

 private:
  [[nodiscard]] VulkanChoices packet_choices() const;
  // Creates rounds_ unless they exist; returns false if the device cannot make rounds.
  bool create_rounds();
  // Where landings go: all of them stay in a buffer, or those of each dispatch are fetched, or they are not wanted.
  struct Record {
    const GpuBuffer* buffer = nullptr;  // of all rays
    std::span<shared::Landing> fetched;
  };
  [[nodiscard]] TraceOutcome follow_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters, const Record& record,
                                         const StopQuestion& stop);
  // Brings rays that took too many steps to their ends.
  void finish_on_cpu(const shared::BeamBlock& beam, std::span<const shared::PausedRay> rays, std::span<std::uint32_t> counters,
                     const Record& record) const;
  // Adds the counts of the device to the counters.
  void add_landings(std::span<std::uint32_t> counters);

  const GpuContext& context_;
  CpuTracer cpu_;
  TraceDomain domain_;
  VulkanChoices choices_;
  const GpuTree& tree_;
  GpuBuffer beam_, counters_;
  GpuBuffer landings_;  // of one dispatch; small until landings are asked for
  std::vector<std::uint32_t> landed_;
  PausedWork<shared::PausedRay, shared::BeamPush> work_;
  std::unique_ptr<VulkanPackets> packets_;  // created with the first packet
  std::unique_ptr<VulkanRounds> rounds_;    // created with the first beam that is kept, or the first pass
  bool leaves_rounds_to_host_ = false;      // because they could not be created
  bool refuses_passes_ = false;             // because one was too large, so that no landings are kept for the next ones
};

}  // namespace sunfleck

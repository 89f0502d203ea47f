#pragma once
// The reference tracer. Walks the tree on all cores with the arithmetic it shares with the shaders, beam rays and other
// parallel rays in bundles, and packets side by side; or tests every element, ray by ray, when the tree itself is in doubt.

#include "devices/tracers/cpu_walk.h"
#include "devices/tracers/dispatch_budget.h"
#include "devices/tracers/landing_counter.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/tracer.h"
#include "shared/layout.h"

namespace sunfleck {

enum class CpuWalk { tree, every_element };

class CpuTracer final : public Tracer {
 public:
  // The tree must outlive the tracer, which checks about every `stop_check_s` seconds whether to stop; 0: less often.
  CpuTracer(const Bvh& bvh, TraceDomain domain, CpuWalk walk = CpuWalk::tree, double stop_check_s = 0.0);

  [[nodiscard]] TracerDevice device() const override;
  [[nodiscard]] bool serves_several() const override { return true; }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override;
  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override;

  // Returns the landing of a packet that has reached `packet.origin` after `crossings` periods.
  [[nodiscard]] shared::Landing follow_packet(const shared::PacketBlock& scene, const shared::Packet& packet,
                                              std::uint32_t crossings) const;

  // Follows a packet that was paused to its end, and returns its landing.
  [[nodiscard]] shared::Landing finish_packet(const shared::PacketBlock& scene, shared::Packet packet,
                                              const shared::PausedPacket& paused) const;

  // Follows one paused ray to its end and counts its landing; `landing` is where it is recorded, or empty.
  void finish_ray(const shared::BeamBlock& beam, const shared::PausedRay& paused, std::span<std::uint32_t> counters,
                  std::span<shared::Landing> landing) const;

 private:
  void trace_part(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                  std::span<shared::Landing> landings) const;
  TraceOutcome count_landings(const shared::BeamBlock& beam, const LandingCounter& landings, const StopQuestion& stop);
  void finish_ray(const shared::BeamBlock& beam, const shared::PausedRay& paused, const LandingCounter& landings) const;
  [[nodiscard]] CpuHit nearest(const shared::Ray& ray, float limit, OwnElement own = {}) const;
  void count_part(const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end, const LandingCounter& landings) const;

  const Bvh& bvh_;
  TraceDomain domain_;
  CpuWalk walk_;
  float triangle_size_squared_;
  DispatchBudget beam_budget_, packet_budget_;  // rays between two checks whether to stop
};

}  // namespace sunfleck

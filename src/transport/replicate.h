#pragma once
// Replicates before they are tallied. Several may be in the making at a time: while the tracer is busy with one, the host draws
// and books the packets of another.

#include "transport/indirect.h"
#include "transport/planes.h"
#include "transport/sky_rays.h"
#include "transport/surfaces.h"
#include "transport/tally.h"
#include "transport/tracer.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// What one replicate brings to the tally.
struct Replicate {
  std::vector<std::uint32_t> counters;  // words as in transport/counters.h
  DirectSums sums;
  PlaneSums passed;
  std::optional<IndirectSums> packets;  // none without an indirect pass
  double direct_s = 0.0;                // wall time, waiting for the tracer included
  double indirect_s = 0.0;
};

// What is to be made. Replicates with the same seed and number are the same, whatever is made beside them.
struct ReplicateOrder {
  double beam_rays = 0.0;       // about how many
  std::uint64_t grid_rays = 0;  // what the grid makes of them
  double packets = 0.0;         // of the first round; 0: no indirect pass
  std::size_t sky_rays = 0;
  double bound = 0.003;  // as IndirectSettings::bound
  std::uint64_t seed = 1;
  std::uint64_t number = 0;
};

class ReplicateMaker {
 public:
  // All must outlive it, and the model must stay as it is.
  ReplicateMaker(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer);

  [[nodiscard]] bool has_indirect_pass() const { return indirect_ != nullptr; }
  [[nodiscard]] bool has_sky() const { return sky_.has_value(); }

  // Of replicates with about so many beam rays.
  [[nodiscard]] Incidence incidence(double beam_rays) const;

  // What adds up replicates of that incidence. The maker must outlive it.
  [[nodiscard]] Tally tally(const Incidence& incidence, ElementErrors element_errors) const;

  // A replicate in which nothing landed, as large as an ordered one.
  [[nodiscard]] Replicate blank(const ReplicateOrder& order) const;

  // Bytes of a replicate's counters and sums, which do not depend on its rays and packets.
  [[nodiscard]] double sum_bytes() const;

  // None if stopped. The tally tells what landings are worth; it may meanwhile add other replicates. May be called by several
  // threads at a time, all of which ask `stop`.
  [[nodiscard]] std::optional<Replicate> make(const ReplicateOrder& order, const Tally& tally, const StopQuestion& stop);

 private:
  // A tracer that serves one thread after the other.
  class OneAtATime final : public Tracer {
   public:
    explicit OneAtATime(Tracer& tracer) : tracer_(tracer) {}
    [[nodiscard]] TracerDevice device() const override { return tracer_.device(); }
    [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                          const StopQuestion& stop) override;
    [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                     std::span<shared::Landing> landings, const StopQuestion& stop) override;

   private:
    Tracer& tracer_;
    std::mutex mutex_;
  };

  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, Replicate& replicate, const StopQuestion& stop);

  [[nodiscard]] const PlaneReceivers* receivers() const { return receivers_ ? &*receivers_ : nullptr; }

  const RadiationModel& model_;
  const CounterLayout& layout_;
  Surfaces surfaces_;
  std::optional<PlaneReceivers> receivers_;
  std::optional<SkyRays> sky_;
  OneAtATime tracer_;
  std::unique_ptr<IndirectPass> indirect_;  // none without a sky where no light goes on after its first landing
};

}  // namespace sunfleck

#pragma once
// Replicates before they are tallied. Several may be made at the same time: while the tracer works on one, the host draws
// and tallies the packets of another.

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

// The sums that one replicate contributes to the tally.
struct Replicate {
  std::vector<std::uint32_t> counters;  // numbered as in transport/counters.h
  DirectSums sums;
  PlaneSums passed;
  std::optional<IndirectSums> packets;  // empty without an indirect pass
  double direct_s = 0.0;                // wall time, including the wait for the tracer
  double indirect_s = 0.0;
};

// The description of one replicate. Replicates with the same seed and number are identical, whatever else is made beside
// them.
struct ReplicateOrder {
  double beam_rays = 0.0;       // approximate number
  std::uint64_t grid_rays = 0;  // actual number of rays on the grid
  double packets = 0.0;         // in the first round; 0: no indirect pass
  std::size_t sky_rays = 0;
  double bound = 0.003;  // as IndirectSettings::bound
  std::uint64_t seed = 1;
  std::uint64_t number = 0;
};

class ReplicateMaker {
 public:
  // All arguments must outlive the maker, and the model must not change.
  ReplicateMaker(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer);

  [[nodiscard]] bool has_indirect_pass() const { return indirect_ != nullptr; }
  [[nodiscard]] bool has_sky() const { return sky_.has_value(); }

  // Returns the incidence of replicates with about this many beam rays.
  [[nodiscard]] Incidence incidence(double beam_rays) const;

  // Returns an empty tally for replicates of that incidence. The maker must outlive it.
  [[nodiscard]] Tally tally(const Incidence& incidence, ElementErrors element_errors) const;

  // Returns a replicate without landings, with all arrays as large as those of an ordered one.
  [[nodiscard]] Replicate blank(const ReplicateOrder& order) const;

  // Returns the size of a replicate's counters and sums in bytes; it does not depend on the numbers of rays and packets.
  [[nodiscard]] double sum_bytes() const;

  // Makes a replicate; returns nothing if stopped. The tally supplies the worth of the landings and may add other
  // replicates meanwhile. Several threads may call this at the same time; all of them call `stop`.
  [[nodiscard]] std::optional<Replicate> make(const ReplicateOrder& order, const Tally& tally, const StopQuestion& stop);

 private:
  // A tracer that serves one thread at a time.
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
  std::unique_ptr<IndirectPass> indirect_;  // null without a sky if no light is scattered after its first landing
};

}  // namespace sunfleck

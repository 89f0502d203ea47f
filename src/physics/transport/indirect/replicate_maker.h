#pragma once
// Makes replicates, each in all lights of a simulation. Several may be made at the same time: while the tracer works on one, the
// host draws and books the packets of another.

#include "physics/transport/indirect/conversion.h"
#include "physics/transport/indirect/pass_arrays.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/indirect/sky_rays.h"
#include "physics/transport/model/canopy_areas.h"
#include "physics/transport/model/stand_aim.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

class ReplicateMaker {
 public:
  // All arguments must outlive the maker, and the models must not change.
  ReplicateMaker(Lights lights, const CounterLayout& layout, Tracer& tracer);
  ReplicateMaker(const RadiationModel& light, const CounterLayout& layout, Tracer& tracer)
      : ReplicateMaker(Lights(&light, 1), layout, tracer) {}

  [[nodiscard]] Lights lights() const { return lights_; }

  [[nodiscard]] bool has_indirect_pass() const { return indirect_.has_value(); }
  [[nodiscard]] bool has_sky() const { return sky_.has_value(); }
  // Returns whether light can be aimed at the scene's stand.
  [[nodiscard]] bool aims() const { return aim_.has_value(); }

  // Returns the incidence of a light in replicates with about this many beam rays; `aimed` as in ReplicateOrder.
  [[nodiscard]] Incidence incidence(double beam_rays, bool aimed, std::size_t light = 0) const;

  // Returns the conversion of a light for replicates of that incidence. The maker must outlive it.
  [[nodiscard]] Conversion conversion(const Incidence& incidence, std::size_t light = 0) const;

  // Returns a replicate without landings, with all arrays as large as those of an ordered one.
  [[nodiscard]] ReplicateSet blank(const ReplicateOrder& order) const;

  // Returns how many replicates are worth making at once: two where software Vulkan needs the cores while it traces, else any
  // number.
  [[nodiscard]] std::size_t most_at_once() const;

  // Returns the size of a replicate's counters and sums in bytes, with hits; it does not depend on the numbers of rays and
  // packets.
  [[nodiscard]] double sum_bytes() const;

  // Returns the part of it that sums by place, of sides and cells of the soil's map, take if light lands on many of them; see
  // PlaceSums.
  [[nodiscard]] PlaceBytes most_place_bytes() const;

  // Returns the memory for what a GPU that makes the rounds finds, in bytes, with hits.
  [[nodiscard]] double device_sum_bytes() const;

  // Returns the memory for where the rays of a beam landed, in bytes, if packets start from this many landings. Rays are recorded if
  // the landings are at least half of them, or if they pass receivers and are not too many. With receivers, the most that a beam of
  // fewer rays may take is counted.
  [[nodiscard]] double record_bytes(double beam_rays, double landings) const;

  // Makes a replicate of the conversions' incidence, [light]; returns nothing if stopped. Several threads may call this at the
  // same time; all of them call `stop`.
  [[nodiscard]] std::optional<ReplicateSet> make(const ReplicateOrder& order, std::span<const Conversion> conversions,
                                                 const StopQuestion& stop);

  // Keeps the memory of a replicate that is no longer needed for the next ones.
  void take_back(ReplicateSet replicates);

  // Frees memory that is kept for the next replicate.
  void free_spare_memory();

 private:
  // A tracer for several threads; they take turns where the one below serves one thread at a time.
  class ForAllThreads final : public Tracer {
   public:
    explicit ForAllThreads(Tracer& tracer) : tracer_(tracer) {}
    [[nodiscard]] TracerDevice device() const override { return tracer_.device(); }
    [[nodiscard]] bool serves_several() const override { return true; }
    [[nodiscard]] bool takes_turns() const { return !tracer_.serves_several(); }
    [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                          const StopQuestion& stop) override;
    [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                          std::span<shared::Landing> landings,
                                                          const StopQuestion& stop) override;
    [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                    const StopQuestion& stop) override;
    [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                     std::span<shared::Landing> landings, const StopQuestion& stop) override;
    [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes,
                                                          const StopQuestion& stop) override;

   private:
    // A pass of one thread, which waits until its own turn comes, or another thread has its rounds made side by side with that
    // one's.
    struct WaitingPass {
      RoundsPass pass;
      const StopQuestion* stop;
      bool is_made = false;
      std::optional<TraceOutcome> outcome;
      std::exception_ptr error;
    };

    [[nodiscard]] std::unique_lock<std::mutex> turn();
    // Makes the rounds of this thread's pass in its turn, and of as many others that wait as the tracer makes side by side.
    void make_waiting(WaitingPass& own);
    // Makes the rounds of passes, and those of one after the other if the tracer has no room for all of them.
    void make_together(std::span<WaitingPass* const> waiting);
    [[nodiscard]] std::vector<WaitingPass*> take_waiting(WaitingPass& own);

    Tracer& tracer_;
    std::mutex mutex_, waiting_mutex_;
    std::vector<WaitingPass*> waiting_;
  };

  // Returns how many rays a beam may have at most whose landings are recorded.
  [[nodiscard]] double most_recorded(double landings) const;
  [[nodiscard]] double plane_bytes() const;
  // Returns whether the rounds may start from landings that the tracer keeps: those of one light in one part, without receivers.
  [[nodiscard]] bool keeps_landings(const ReplicateOrder& order) const;
  // Traces the beam of first.beam, and has its landings kept by the tracer, or records them in `recorded` if record_bytes says
  // so.
  [[nodiscard]] TraceOutcome count_beam(const ReplicateOrder& order, Replicate& replicate, FirstLandings& first,
                                        std::vector<shared::Landing>& recorded, const StopQuestion& stop);
  // Traces the beam of one light; returns false if stopped.
  [[nodiscard]] bool make_direct(const ReplicateOrder& order, std::size_t light, const Conversion& conversion,
                                 Replicate& replicate, FirstLandings& first, std::vector<shared::Landing>& recorded,
                                 const StopQuestion& stop);
  // Makes a replicate with the help of arrays.
  [[nodiscard]] std::optional<ReplicateSet> make(const ReplicateOrder& order, std::span<const Conversion> conversions,
                                                 PassArrays& arrays, const StopQuestion& stop);

  [[nodiscard]] const StandAim* aim(bool aimed) const { return aimed && aim_ ? &*aim_ : nullptr; }
  [[nodiscard]] const SkyRays& sky(bool aimed) const { return aimed && aimed_sky_ ? *aimed_sky_ : *sky_; }
  [[nodiscard]] const PlaneReceivers* receivers() const { return receivers_ ? &*receivers_ : nullptr; }

  Lights lights_;
  const RadiationModel& model_;  // the first light
  const CounterLayout& layout_;
  Surfaces surfaces_;
  std::vector<std::unique_ptr<const CanopyAreas>> areas_;  // [light]
  std::optional<PlaneReceivers> receivers_;
  std::optional<StandAim> aim_;
  std::optional<SkyRays> sky_, aimed_sky_;
  ForAllThreads tracer_;
  SparePassArrays spare_;
  SpareVectors<std::uint32_t> spare_counters_;
  std::optional<IndirectScene> indirect_;  // empty without a sky if no light is scattered after its first landing
};

}  // namespace sunfleck

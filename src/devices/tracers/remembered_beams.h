#pragma once
// A tracer that remembers what beams have hit. Their landings depend only on the sun and the canopy, so that no beam needs to
// be traced again for other optics or another sky.

#include "physics/transport/model/tracer.h"
#include "shared/layout.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {

class RememberedBeams final : public Tracer {
 public:
  // The tracer must outlive the object. Keeps the landings of as many beams of one direction as fit into `most_bytes`; a beam
  // from another direction replaces them.
  RememberedBeams(Tracer& tracer, std::size_t most_bytes) : tracer_(tracer), most_bytes_(most_bytes) {}

  // Returns the number of beams that were not traced because they were remembered.
  [[nodiscard]] std::uint64_t spared() const { return spared_; }

  [[nodiscard]] TracerDevice device() const override { return tracer_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override;
  // This and the next one return nothing for a beam that it remembers.
  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override;
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override;

 private:
  struct Beam {
    shared::BeamBlock block;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> landed;  // word of the counters, count; only words that are not 0
  };

  void forget();
  [[nodiscard]] const Beam* find(const shared::BeamBlock& beam) const;  // null if it is not remembered
  void take_counted(const shared::BeamBlock& beam, std::span<std::uint32_t> counters);

  Tracer& tracer_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::atomic<std::uint64_t> spared_ = 0;
  std::vector<Beam> beams_;
  std::vector<std::uint32_t> counted_;  // of one beam
};

}  // namespace sunfleck

#pragma once
// A tracer that passes rays on to another one, which neither records beams nor makes rounds. Tests change a part of it.

#include "physics/transport/model/tracer.h"

namespace sunfleck::test {

class WrappedTracer : public Tracer {
 public:
  // The other tracer must outlive this one.
  explicit WrappedTracer(Tracer& inner) : inner_(inner) {}

  [[nodiscard]] TracerDevice device() const override { return inner_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override {
    return inner_.count_beam(beam, counters, stop);
  }
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    return inner_.trace(scene, packets, landings, stop);
  }

 private:
  Tracer& inner_;
};

}  // namespace sunfleck::test

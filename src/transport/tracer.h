#pragma once
// The interface between the solver and whatever sends rays. A tracer knows geometry only: which side of which element a ray
// lands on, and where. Everything it returns is an integer.

#include "shared/layout.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace sunfleck {

// The device a tracer works on, as summary.json names it.
struct TracerDevice {
  std::string kind;  // "vulkan" or "cpu"
  std::string name;
  std::string driver;
  bool software = true;
};

// Asked now and then during long work; true ends it.
using StopQuestion = std::function<bool()>;

enum class TraceOutcome { finished, stopped };

class Tracer {
 public:
  virtual ~Tracer() = default;

  [[nodiscard]] virtual TracerDevice device() const = 0;

  // Traces all rays of one replicate and adds their landings to `counters` (words as in transport/counters.h). Stopped: the
  // counters hold part of the rays and are of no use.
  [[nodiscard]] virtual TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                const StopQuestion& stop) = 0;

  // Follows every packet to its end: landings[k] tells where packets[k] landed. Stopped: the landings are of no use.
  [[nodiscard]] virtual TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                           std::span<shared::Landing> landings, const StopQuestion& stop) = 0;
};

}  // namespace sunfleck

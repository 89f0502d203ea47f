#pragma once
// The interface between the solver and the devices that trace rays. A tracer knows only geometry: which side of which
// element a ray lands on, and where. Everything it counts is an integer.

#include "shared/layout.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

// The device on which a tracer runs, as named in summary.json.
struct TracerDevice {
  std::string kind;  // "vulkan" or "cpu"
  std::string name;
  std::string driver;
  bool software = true;
};

// Called now and then during long work; a result of true ends the work.
using StopQuestion = std::function<bool()>;

enum class TraceOutcome { finished, stopped };

// Where the rays of a beam landed, kept where the tracer works until its last owner lets go of it. The tracer's device must
// outlive it.
class KeptLandings {
 public:
  KeptLandings() = default;
  virtual ~KeptLandings() = default;
  KeptLandings(const KeptLandings&) = delete;
  KeptLandings& operator=(const KeptLandings&) = delete;
};
struct KeptBeam {
  TraceOutcome outcome;
  std::shared_ptr<const KeptLandings> landings;  // of no use if stopped
};

// The rounds of an indirect pass that a device makes on its own, and what it finds (physics/transport/indirect/device_rounds.h).
struct RoundsOrder;
struct RoundsSums;
struct RoundsPass {
  const RoundsOrder* order;
  RoundsSums* sums;
};

class Tracer {
 public:
  virtual ~Tracer() = default;

  [[nodiscard]] virtual TracerDevice device() const = 0;

  // Returns whether several threads may trace at the same time.
  [[nodiscard]] virtual bool serves_several() const { return false; }

  // Traces all rays of one replicate and adds their landings to `counters` (numbered as in physics/transport/model/counters.h).
  // If stopped, the counters hold only part of the rays and must not be used.
  [[nodiscard]] virtual TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                const StopQuestion& stop) = 0;

  // Does the same, and sets landings[ray] to where each ray landed: what trace() would find. Returns nothing, and does nothing,
  // if recording costs the tracer more than it saves.
  [[nodiscard]] virtual std::optional<TraceOutcome> record_beam(const shared::BeamBlock& /*beam*/,
                                                                std::span<std::uint32_t> /*counters*/,
                                                                std::span<shared::Landing> /*landings*/,
                                                                const StopQuestion& /*stop*/) {
    return std::nullopt;
  }

  // Does what count_beam() does, and keeps where each ray landed for make_rounds(). Returns nothing, and does nothing, if the
  // tracer makes no rounds or is short of memory.
  [[nodiscard]] virtual std::optional<KeptBeam> keep_beam(const shared::BeamBlock& /*beam*/,
                                                          std::span<std::uint32_t> /*counters*/, const StopQuestion& /*stop*/) {
    return std::nullopt;
  }

  // Follows every packet to its end; landings[k] is where packets[k] landed. If stopped, the landings must not be used.
  [[nodiscard]] virtual TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                           std::span<shared::Landing> landings, const StopQuestion& stop) = 0;

  // Returns how many passes make_rounds() makes side by side, at most.
  [[nodiscard]] virtual std::size_t most_passes() const { return 1; }

  // Makes all rounds of indirect passes of one scene where the tracer works, so that packets need not come to the host, and
  // sets their sums. Returns nothing if it cannot. If it does, or is stopped, the sums must not be used.
  [[nodiscard]] virtual std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> /*passes*/,
                                                                const StopQuestion& /*stop*/) {
    return std::nullopt;
  }
};

}  // namespace sunfleck

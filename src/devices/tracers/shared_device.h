#pragma once
// Shares one device between a thread that draws and one that simulates. Drawing has priority.

#include "devices/tracers/canopy_view.h"
#include "physics/transport/model/tracer.h"

#include <condition_variable>
#include <memory>
#include <mutex>

namespace sunfleck {

// Arbitrates the device. Tracing gives way between two dispatches, so that drawing waits for one dispatch at most.
class DeviceTurn {
 public:
  void begin_drawing();
  void begin_tracing();
  void end();
  // Lets waiting drawings have their turn; called by the tracing thread.
  void give_way();

 private:
  std::mutex mutex_;
  std::condition_variable free_;
  bool taken_ = false;
  int drawings_waiting_ = 0;
};

// Holds a turn for the lifetime of the object.
template <void (DeviceTurn::*begin)()>
class HeldTurn {
 public:
  explicit HeldTurn(DeviceTurn& turn) : turn_(turn) { (turn_.*begin)(); }
  ~HeldTurn() { turn_.end(); }
  HeldTurn(const HeldTurn&) = delete;
  HeldTurn& operator=(const HeldTurn&) = delete;

 private:
  DeviceTurn& turn_;
};
using DrawingTurn = HeldTurn<&DeviceTurn::begin_drawing>;
using TracingTurn = HeldTurn<&DeviceTurn::begin_tracing>;

// A tracer that takes turns; both arguments must outlive it.
class TurnTakingTracer final : public Tracer {
 public:
  TurnTakingTracer(Tracer& tracer, DeviceTurn& turn) : tracer_(tracer), turn_(turn) {}
  [[nodiscard]] TracerDevice device() const override { return tracer_.device(); }
  [[nodiscard]] TraceOutcome count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                        const StopQuestion& stop) override;
  [[nodiscard]] std::optional<TraceOutcome> record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                        std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::optional<KeptBeam> keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                  const StopQuestion& stop) override;
  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override;
  [[nodiscard]] std::optional<TraceOutcome> make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) override;

 private:
  [[nodiscard]] StopQuestion giving_way(const StopQuestion& stop) const;

  Tracer& tracer_;
  DeviceTurn& turn_;
};

// A viewer that takes turns; the turn must outlive it.
class TurnTakingViewer final : public CanopyViewer {
 public:
  TurnTakingViewer(std::unique_ptr<CanopyViewer> viewer, DeviceTurn& turn) : viewer_(std::move(viewer)), turn_(turn) {}
  ~TurnTakingViewer() override;
  void aim(CanopyLook look) override;
  [[nodiscard]] std::vector<shared::SeenSurface> see(std::uint32_t first_row, std::uint32_t rows,
                                                     const StopQuestion& stop) override;

 private:
  std::unique_ptr<CanopyViewer> viewer_;
  DeviceTurn& turn_;
};

}  // namespace sunfleck

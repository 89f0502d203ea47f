#include "devices/tracers/shared_device.h"

#include <utility>

namespace sunfleck {
void DeviceTurn::begin_drawing() {
  std::unique_lock lock(mutex_);
  ++drawings_waiting_;
  free_.wait(lock, [&] { return !taken_; });
  --drawings_waiting_;
  taken_ = true;
}

void DeviceTurn::begin_tracing() {
  std::unique_lock lock(mutex_);
  free_.wait(lock, [&] { return !taken_ && drawings_waiting_ == 0; });
  taken_ = true;
}

void DeviceTurn::end() {
  {
    const std::lock_guard lock(mutex_);
    taken_ = false;
  }
  free_.notify_all();
}

void DeviceTurn::give_way() {
  {
    const std::lock_guard lock(mutex_);
    if (drawings_waiting_ == 0) return;
  }
  end();
  begin_tracing();
}

StopQuestion TurnTakingTracer::giving_way(const StopQuestion& stop) const {
  return [this, &stop] {
    turn_.give_way();
    return stop && stop();
  };
}

TraceOutcome TurnTakingTracer::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                          const StopQuestion& stop) {
  const TracingTurn turn(turn_);
  return tracer_.count_beam(beam, counters, giving_way(stop));
}

std::optional<TraceOutcome> TurnTakingTracer::record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                          std::span<shared::Landing> landings, const StopQuestion& stop) {
  const TracingTurn turn(turn_);
  return tracer_.record_beam(beam, counters, landings, giving_way(stop));
}

std::optional<KeptBeam> TurnTakingTracer::keep_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                    const StopQuestion& stop) {
  const TracingTurn turn(turn_);
  return tracer_.keep_beam(beam, counters, giving_way(stop));
}

TraceOutcome TurnTakingTracer::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                     std::span<shared::Landing> landings, const StopQuestion& stop) {
  const TracingTurn turn(turn_);
  return tracer_.trace(scene, packets, landings, giving_way(stop));
}

std::optional<TraceOutcome> TurnTakingTracer::make_rounds(std::span<const RoundsPass> passes, const StopQuestion& stop) {
  const TracingTurn turn(turn_);
  return tracer_.make_rounds(passes, giving_way(stop));
}

TurnTakingViewer::~TurnTakingViewer() {
  const DrawingTurn turn(turn_);
  viewer_.reset();
}

void TurnTakingViewer::aim(CanopyLook look) {
  const DrawingTurn turn(turn_);
  viewer_->aim(std::move(look));
}

std::vector<shared::SeenSurface> TurnTakingViewer::see(std::uint32_t first_row, std::uint32_t rows, const StopQuestion& stop) {
  const DrawingTurn turn(turn_);
  return viewer_->see(first_row, rows, stop);
}

}  // namespace sunfleck

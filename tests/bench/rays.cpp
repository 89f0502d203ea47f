#include "bench/rays.h"

#include "devices/tracers/cpu_tracer.h"
#include "physics/transport/model/beam_block.h"
#include "physics/transport/solve/solve.h"
#include "support/wrapped_tracer.h"

#include <algorithm>
#include <random>

namespace sunfleck::bench {
namespace {

// Passes everything on to the CPU path, and keeps the first packets that leave elements.
class Recorder final : public test::WrappedTracer {
 public:
  using WrappedTracer::WrappedTracer;

  [[nodiscard]] TraceOutcome trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                                   std::span<shared::Landing> landings, const StopQuestion& stop) override {
    const bool leave = !packets.empty() && packets.front().element != shared::no_element;
    if (leave && kept_.empty()) kept_.assign(packets.begin(), packets.end());
    return WrappedTracer::trace(scene, packets, landings, stop);
  }
  [[nodiscard]] std::vector<shared::Packet> kept() && { return std::move(kept_); }
  [[nodiscard]] bool done() const { return !kept_.empty(); }

 private:
  std::vector<shared::Packet> kept_;
};

}  // namespace

shared::BeamBlock beam_of(const Stand& stand, double rays, std::uint64_t replicate) {
  return make_beam_block(stand.model, stand.prepared.layout, rays, 1, replicate);
}

std::vector<shared::Packet> packets_of(const Stand& stand, double packets, Order order, std::uint64_t seed) {
  SolveSettings settings;
  settings.seed = seed;
  settings.passes = 8;
  settings.grid_m = std::sqrt(stand.model.plot.area_m2() / (packets * *settings.passes));
  settings.packets = packets;
  settings.replicates_at_once = 1;
  CpuTracer tracer(stand.prepared.bvh, stand.tracer_scene());
  Recorder recorder(tracer);
  Monitor until_recorded;
  until_recorded.interrupted = [&recorder] { return recorder.done(); };
  (void)solve(stand.model, stand.prepared.layout, recorder, settings, until_recorded);
  std::vector<shared::Packet> result = std::move(recorder).kept();
  if (order == Order::random) std::shuffle(result.begin(), result.end(), std::mt19937_64(seed));
  return result;
}

std::vector<shared::Packet> as_packets(const shared::BeamBlock& beam) {
  std::vector<shared::Packet> packets(std::size_t{beam.columns} * beam.rows);
  for (std::uint32_t ray = 0; ray < packets.size(); ++ray) {
    packets[ray] = beam_packet(beam, ray);
  }
  return packets;
}

}  // namespace sunfleck::bench

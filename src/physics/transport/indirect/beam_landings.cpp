#include "physics/transport/indirect/beam_landings.h"

#include "base/in_blocks.h"
#include "base/prefetch.h"
#include "shared/beam.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

namespace sunfleck {
namespace {

// Number of rays passed to the tracer in one call.
constexpr std::uint32_t rays_at_once = 1U << 18U;

// Returns the word in which Tracer::count_beam would count the landing.
std::uint32_t counter_word(const RadiationModel& model, const CounterLayout& layout, const shared::BeamBlock& beam,
                           const shared::Landing& landing) {
  if (landing.surface == shared::landed_on_ground) {
    return shared::counter_first_cell + shared::soil_cell(beam.ground, {landing.place_a, landing.place_b});
  }
  const std::uint32_t element = landing.surface / 2;
  const Triangle& corners = model.canopy.corners[element];
  const float y = shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b);
  const std::uint32_t bin = layout.first_bin[element] + layer_at(layout.layers, y) - first_layer(layout, corners);
  return layout.first_bin_word + 2 * bin + landing.surface % 2;
}

// Returns true if a ray that left downwards fell through the plot, false if it passed beside it. Only isolated stands
// without soil need the distinction.
bool fell_through_plot(const shared::BeamBlock& beam, const shared::Packet& ray) {
  return shared::falls_on_plot(shared::make_ray(ray.origin, ray.direction), beam.ground);
}

using TakeLanding = std::function<void(const shared::Packet& ray, const shared::Landing& landing)>;

// Counts which receivers some rays pass. Several threads may count into the same sums. Neighbouring rays often pass the same cell, so
// that a thread first adds up those that follow each other; otherwise threads would compete for one counter.
class CrossingCounter {
 public:
  // All arguments must outlive the object, which adds the last rays when it is destroyed.
  CrossingCounter(const RadiationModel& model, const PlaneReceivers& planes, PlaneSums& sums)
      : model_(model),
        planes_(planes),
        sums_(sums),
        in_cell_(planes.size()),
        zone_landings_((planes.size() + 1) * model.optics.size()) {}
  CrossingCounter(const CrossingCounter&) = delete;
  CrossingCounter& operator=(const CrossingCounter&) = delete;
  ~CrossingCounter() {
    for (const InCell& rays : in_cell_) add(rays);
    for (std::size_t k = 0; k < zone_landings_.size(); ++k) {
      add(sums_.zone_landings[k].upper, zone_landings_[k].upper);
      add(sums_.zone_landings[k].lower, zone_landings_[k].lower);
    }
  }

  void add(const shared::Packet& ray, const shared::Landing& landing) {
    const std::size_t zone = planes_.zone_of(landing);
    if (landing.surface < shared::landed_on_ground) {
      BeamLandings& in_zone = zone_landings_[zone * model_.optics.size() + model_.canopy.optics_of[landing.surface / 2]];
      ++(landing.surface % 2 == 0 ? in_zone.upper : in_zone.lower);
    }
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      const std::uint32_t cell = planes_.cell_at(p, ray.origin, ray.direction);
      InCell& rays = in_cell_[p];
      if (cell != rays.cell) add(std::exchange(rays, {cell, 0, 0}));
      ++rays.crossing;
      rays.reached += p >= zone ? 1 : 0;
    }
  }

 private:
  // Rays that pass a cell one after the other.
  struct InCell {
    std::uint32_t cell = shared::no_cell;
    std::uint32_t crossing = 0, reached = 0;
  };

  template <class Count>
  static void add(Count& sum, Count count) {
    if (count > 0) std::atomic_ref(sum).fetch_add(count, std::memory_order_relaxed);
  }
  void add(const InCell& rays) {
    if (rays.cell == shared::no_cell) return;
    add(sums_.crossing[rays.cell], rays.crossing);
    add(sums_.reached[rays.cell], rays.reached);
  }

  const RadiationModel& model_;
  const PlaneReceivers& planes_;
  PlaneSums& sums_;
  std::vector<InCell> in_cell_;              // [plane]
  std::vector<BeamLandings> zone_landings_;  // as in PlaneSums
};

// Traces all rays of a part, counts them, and hands those over that were not lost.
TraceOutcome trace_part(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const BeamPart& part,
                        std::span<std::uint32_t> counters, const StopQuestion& stop, const TakeLanding& take) {
  const shared::PacketBlock scene = make_packet_block(model, layout);
  const shared::BeamBlock& beam = part.block;
  const std::uint32_t rays = beam.columns * beam.rows;
  std::vector<shared::Packet> packets(std::min(rays, rays_at_once));
  std::vector<shared::Landing> landings(packets.size());
  for (std::uint32_t first = 0; first < rays; first += rays_at_once) {
    const std::uint32_t count = std::min(rays_at_once, rays - first);
    for (std::uint32_t k = 0; k < count; ++k) packets[k] = beam_packet(beam, first + k);
    const std::span sent(packets.data(), count);
    if (tracer.trace(scene, sent, std::span(landings.data(), count), stop) == TraceOutcome::stopped) {
      return TraceOutcome::stopped;
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      const shared::Landing& landing = landings[k];
      if (landing.surface == shared::lost_on_its_way) {
        counters[shared::counter_lost] += part.weight;
        continue;
      }
      const bool left = landing.surface > shared::landed_on_ground;
      const bool met = model.plot.periodic || !left || fell_through_plot(beam, sent[k]);
      if (!left) counters[counter_word(model, layout, beam, landing)] += part.weight;
      if (left) counters[met ? shared::counter_transmitted : shared::counter_missed] += part.weight;
      if (!model.plot.periodic && met) counters[shared::counter_met] += part.weight;
      if (take) take(sent[k], landing);
    }
  }
  return TraceOutcome::finished;
}

}  // namespace

TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const BeamPart& part,
                                 std::span<std::uint32_t> counters, const StopQuestion& stop) {
  return trace_part(model, layout, tracer, part, counters, stop, nullptr);
}

TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout, const PlaneReceivers& planes,
                                 Tracer& tracer, const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                 PlaneSums& sums, const StopQuestion& stop) {
  CrossingCounter counter(model, planes, sums);
  return trace_part(model, layout, tracer, {beam, 1}, counters, stop,
                    [&](const shared::Packet& ray, const shared::Landing& landing) { counter.add(ray, landing); });
}

void add_crossings(const RadiationModel& model, const PlaneReceivers& planes, const shared::BeamBlock& beam,
                   std::span<const shared::Landing> landings, PlaneSums& sums) {
  constexpr std::size_t block_size = 1U << 14U;
  in_blocks(landings.size(), block_size, [&](std::size_t, std::size_t first, std::size_t end) {
    CrossingCounter counter(model, planes, sums);
    for (std::size_t ray = first; ray < end; ++ray) {
      if (ray + prefetch_ahead < end && landings[ray + prefetch_ahead].surface < shared::landed_on_ground) {
        model.canopy.corners.prefetch(landings[ray + prefetch_ahead].surface / 2);
      }
      if (landings[ray].surface == shared::lost_on_its_way) continue;
      counter.add(beam_packet(beam, static_cast<std::uint32_t>(ray)), landings[ray]);
    }
  });
}

}  // namespace sunfleck

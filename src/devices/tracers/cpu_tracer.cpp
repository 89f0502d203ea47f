#include "devices/tracers/cpu_tracer.h"

#include "base/stopwatch.h"
#include "devices/tracers/beam_bundles.h"
#include "devices/tracers/beam_way.h"
#include "devices/tracers/packet_bundles.h"
#include "devices/tracers/packet_way.h"
#include "devices/tracers/side_by_side.h"
#include "shared/beam.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace sunfleck {
namespace {

// Largest number of rays between two checks whether to stop: a fraction of a second.
constexpr std::uint32_t rays_per_slice = 1U << 18U;
constexpr std::uint32_t packets_per_slice = 1U << 17U;
// Low rays through a small plot may cross half a million periods; all rays of a slice cross about as many at most.
constexpr double crossings_per_slice = 0x1p22;

// Returns how many periods a ray crosses that falls from top to ground, if it meets nothing. Directions of all kinds, which a
// direction of 0 stands for, cross few on average.
double crossings_of_fall(double fall_m, const glm::vec2& period_m, const glm::vec3& direction) {
  const glm::dvec2 periods = fall_m / glm::dvec2(period_m);
  if (direction == glm::vec3(0.0F)) return 2.0 * (periods.x + periods.y);
  const double down = std::abs(double{direction.y});
  return (periods.x * std::abs(direction.x) + periods.y * std::abs(direction.z)) / std::max(down, 1e-30);
}

// The rays that are followed between two checks whether to stop.
struct Slice {
  std::uint32_t rays = 0, rays_at_least = 0;  // of a slice, and of a thread's part of it

  // Has `most` rays at most, which threads share in parts of `batch`.
  Slice(std::uint32_t most, std::uint32_t batch, double crossings) : rays(most), rays_at_least(batch) {
    const double few = crossings_per_slice / (1.0 + std::min<double>(crossings, shared::max_crossings));
    if (few >= most) return;
    constexpr std::uint32_t parts = 32;
    rays = std::max(parts, static_cast<std::uint32_t>(few));
    rays_at_least = std::clamp(rays / parts, 1U, batch);
  }
};

// Follows beam rays side by side.
class BeamSearches final : public SearchSource {
 public:
  BeamSearches(const shared::BeamBlock& beam, TraceDomain domain, std::uint32_t first, std::uint32_t end,
               const LandingCounter& landings)
      : beam_(beam), domain_(domain), next_(first), end_(end), landings_(landings) {}

  bool begin(std::size_t slot, Search& search) override {
    if (next_ == end_) return false;
    ways_[slot] = BeamWay(beam_, domain_, landings_, next_, shared::beam_origin(beam_, next_), 0, search);
    ++next_;
    return true;
  }

  bool next(std::size_t slot, const CpuHit& hit, Search& search) override {
    return ways_[slot].goes_on(hit, search) || begin(slot, search);
  }

 private:
  const shared::BeamBlock& beam_;
  TraceDomain domain_;
  std::uint32_t next_, end_;
  const LandingCounter& landings_;
  std::array<BeamWay, searches_at_once> ways_;
};

// Follows packets side by side.
class PacketSearches final : public SearchSource {
 public:
  PacketSearches(const shared::PacketBlock& scene, TraceDomain domain, std::span<const shared::Packet> packets,
                 std::span<shared::Landing> landings)
      : scene_(scene), domain_(domain), packets_(packets), landings_(landings) {}

  bool begin(std::size_t slot, Search& search) override {
    if (begun_ == packets_.size()) return false;
    packet_of_[slot] = begun_;
    std::construct_at(&ways_[slot], scene_, domain_, packets_[begun_++], 0U, search);
    return true;
  }

  bool next(std::size_t slot, const CpuHit& hit, Search& search) override {
    if (ways_[slot].goes_on(hit, search)) return true;
    landings_[packet_of_[slot]] = ways_[slot].landing();
    return begin(slot, search);
  }

 private:
  const shared::PacketBlock& scene_;
  TraceDomain domain_;
  std::span<const shared::Packet> packets_;
  std::span<shared::Landing> landings_;
  std::size_t begun_ = 0;
  std::array<std::size_t, searches_at_once> packet_of_{};
  std::array<PacketWay, searches_at_once> ways_;
};

}  // namespace

CpuTracer::CpuTracer(const Bvh& bvh, TraceDomain domain, CpuWalk walk, double stop_check_s)
    : bvh_(bvh),
      domain_(domain),
      walk_(walk),
      triangle_size_squared_(triangle_size_squared(bvh)),
      beam_budget_(rays_per_slice, stop_check_s),
      packet_budget_(packets_per_slice, stop_check_s) {}

TracerDevice CpuTracer::device() const {
  return {"cpu", walk_ == CpuWalk::tree ? "CPU path" : "CPU path, every element tested", "", true};
}

CpuHit CpuTracer::nearest(const shared::Ray& ray, float limit, OwnElement own) const {
  return walk_ == CpuWalk::tree ? nearest_hit(bvh_, ray, limit, Images::all, own) : nearest_hit_of_all(bvh_, ray, limit, own);
}

void CpuTracer::finish_ray(const shared::BeamBlock& beam, const shared::PausedRay& paused, std::span<std::uint32_t> counters,
                           std::span<shared::Landing> landing) const {
  finish_ray(beam, paused, LandingCounter(bvh_, domain_, beam, counters, landing, paused.ray));
}

void CpuTracer::finish_ray(const shared::BeamBlock& beam, const shared::PausedRay& paused,
                           const LandingCounter& landings) const {
  Search search;
  BeamWay way(beam, domain_, landings, paused.ray, paused.origin, paused.crossings, search);
  while (way.goes_on(nearest(search.ray, search.limit), search)) {
  }
}

void CpuTracer::count_part(const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end,
                           const LandingCounter& landings) const {
  if (walk_ == CpuWalk::every_element) {
    for (std::uint32_t ray = first; ray < end; ++ray) {
      finish_ray(beam, {shared::beam_origin(beam, ray), 0, ray, 0}, landings);
    }
  } else if (pays_in_bundles(beam, triangle_size_squared_)) {
    count_in_bundles(bvh_, domain_, beam, first, end, landings);
  } else {
    BeamSearches searches(beam, domain_, first, end, landings);
    search_side_by_side(bvh_, searches);
  }
}

TraceOutcome CpuTracer::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters, const StopQuestion& stop) {
  return count_landings(beam, LandingCounter(bvh_, domain_, beam, counters, {}), stop);
}

std::optional<TraceOutcome> CpuTracer::record_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                                                   std::span<shared::Landing> landings, const StopQuestion& stop) {
  return count_landings(beam, LandingCounter(bvh_, domain_, beam, counters, landings), stop);
}

TraceOutcome CpuTracer::count_landings(const shared::BeamBlock& beam, const LandingCounter& landings,
                                       const StopQuestion& stop) {
  const std::uint32_t rays = beam.columns * beam.rows;
  const double fall_m = double{beam.corner.y} - double{beam.ground.y};
  const double crossings = domain_.periodic ? crossings_of_fall(fall_m, beam.period, beam.direction) : 0.0;
  for (std::uint32_t first = 0; first < rays;) {
    if (stop && stop()) return TraceOutcome::stopped;
    const Stopwatch watch;
    const Slice slice(beam_budget_.rays(), rays_per_batch, crossings);
    const std::uint32_t end = first + std::min(slice.rays, rays - first);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, end, slice.rays_at_least),
                      [&](const auto& range) { count_part(beam, range.begin(), range.end(), landings); });
    beam_budget_.record_duration(end - first, watch.seconds());
    first = end;
  }
  return TraceOutcome::finished;
}

shared::Landing CpuTracer::follow_packet(const shared::PacketBlock& scene, const shared::Packet& packet,
                                         std::uint32_t crossings) const {
  Search search;
  PacketWay way(scene, domain_, packet, crossings, search);
  while (way.goes_on(nearest(search.ray, search.limit, search.own), search)) {
  }
  return way.landing();
}

shared::Landing CpuTracer::finish_packet(const shared::PacketBlock& scene, shared::Packet packet,
                                         const shared::PausedPacket& paused) const {
  packet.origin = paused.origin;
  packet.image = paused.image;
  return follow_packet(scene, packet, paused.crossings);
}

void CpuTracer::trace_part(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                           std::span<shared::Landing> landings) const {
  if (walk_ == CpuWalk::every_element) {
    for (std::size_t k = 0; k < packets.size(); ++k) landings[k] = follow_packet(scene, packets[k], 0);
  } else if (!trace_in_bundles(bvh_, scene, domain_, triangle_size_squared_, packets, landings)) {
    PacketSearches searches(scene, domain_, packets, landings);
    search_side_by_side(bvh_, searches);
  }
}

TraceOutcome CpuTracer::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                              std::span<shared::Landing> landings, const StopQuestion& stop) {
  const double fall_m = double{scene.top_y} - double{scene.ground.y};
  for (std::size_t first = 0; first < packets.size();) {
    if (stop && stop()) return TraceOutcome::stopped;
    const Stopwatch watch;
    const bool parallel = have_one_direction(packets.subspan(first, std::min<std::size_t>(2, packets.size() - first)));
    const glm::vec3 direction = parallel ? packets[first].direction : glm::vec3(0.0F);
    const double crossings = domain_.periodic ? crossings_of_fall(fall_m, scene.period, direction) : 0.0;
    const Slice slice(packet_budget_.rays(), parallel ? rays_per_batch : 256, crossings);
    const std::size_t end = std::min(packets.size(), first + slice.rays);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, slice.rays_at_least), [&](const auto& range) {
      trace_part(scene, packets.subspan(range.begin(), range.size()), landings.subspan(range.begin(), range.size()));
    });
    packet_budget_.record_duration(static_cast<std::uint32_t>(end - first), watch.seconds());
    first = end;
  }
  return TraceOutcome::finished;
}

}  // namespace sunfleck

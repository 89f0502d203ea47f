#include "shared/beam.h"
#include "tracers/cpu_tracer.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace sunfleck {
namespace {

shared::Landing landing_of(const CpuHit& hit) {
  return {2 * hit.element + hit.lower, hit.triangle, hit.weight_b, hit.weight_c};
}

shared::Landing ground_landing(const shared::Ray& ray, float t, bool has_soil) {
  const glm::vec2 at = shared::ground_point(ray, t);
  return {has_soil ? shared::landed_on_ground : shared::left_downwards, 0, at.x, at.y};
}

}  // namespace

shared::Landing CpuTracer::follow_in_isolated_stand(const shared::PacketBlock& scene, const shared::Ray& ray,
                                                    OwnElement own) const {
  const bool down = ray.inverse.y < 0.0F;
  const shared::Ground ground = shared::meet_ground(ray, scene.ground);
  const bool over_plot = down && shared::falls_on_plot(ray, scene.ground);
  const CpuHit hit = nearest(ray, over_plot ? ground.limit : 1e30F, own);
  if (hit.found) return landing_of(hit);
  if (over_plot) return ground_landing(ray, ground.t, scene_.has_soil);
  return {down ? shared::left_downwards : shared::left_upwards, 0, 0.0F, 0.0F};
}

shared::Landing CpuTracer::follow_in_endless_canopy(const shared::PacketBlock& scene, shared::Ray ray, OwnElement own,
                                                    std::uint32_t crossings) const {
  const bool down = ray.inverse.y < 0.0F;
  while (true) {
    const shared::Ground end = down ? shared::meet_ground(ray, scene.ground) : shared::meet_top(ray, scene.top_y);
    const shared::Crossing crossing = shared::next_crossing(ray, scene.period, scene.overlap);
    const CpuHit hit = nearest(ray, end.limit < crossing.limit ? end.limit : crossing.limit, own);
    if (hit.found) return landing_of(hit);
    if (end.t <= crossing.t) {
      return down ? ground_landing(ray, end.t, scene_.has_soil) : shared::Landing{shared::left_upwards, 0, 0.0F, 0.0F};
    }
    if (++crossings > shared::max_crossings) return {shared::lost_on_its_way, 0, 0.0F, 0.0F};
    ray.origin = shared::enter_next_period(ray, crossing, scene.period);
    own.image = shared::image_in_next_period(own.image, ray, crossing.along_x);
  }
}

shared::Landing CpuTracer::follow_packet(const shared::PacketBlock& scene, const shared::Packet& packet,
                                         std::uint32_t crossings) const {
  const shared::Ray ray = shared::make_ray(packet.origin, packet.direction);
  const OwnElement own{packet.element, packet.image};
  return scene_.periodic ? follow_in_endless_canopy(scene, ray, own, crossings) : follow_in_isolated_stand(scene, ray, own);
}

TraceOutcome CpuTracer::trace(const shared::PacketBlock& scene, std::span<const shared::Packet> packets,
                              std::span<shared::Landing> landings, const StopQuestion& stop) {
  for (std::size_t first = 0; first < packets.size();) {
    if (stop && stop()) return TraceOutcome::stopped;
    const DispatchClock clock;
    const std::size_t end = std::min(packets.size(), first + packet_budget_.rays());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, 256), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k) landings[k] = follow_packet(scene, packets[k], 0);
    });
    packet_budget_.took(static_cast<std::uint32_t>(end - first), clock.seconds());
    first = end;
  }
  return TraceOutcome::finished;
}

}  // namespace sunfleck

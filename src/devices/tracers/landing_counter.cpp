#include "devices/tracers/landing_counter.h"

#include "shared/beam.h"

#include <algorithm>
#include <atomic>

namespace sunfleck {

void LandingCounter::count(std::uint32_t counter) const {
  std::atomic_ref<std::uint32_t>(counters_[counter]).fetch_add(1, std::memory_order_relaxed);
}

void LandingCounter::count_missed(std::uint32_t number) const {
  count(shared::counter_missed);
  record(number, {shared::left_downwards, 0, 0.0F, 0.0F});
}

void LandingCounter::count_lost(std::uint32_t number) const {
  count(shared::counter_lost);
  record(number, {shared::lost_on_its_way, 0, 0.0F, 0.0F});
}

void LandingCounter::count_element(std::uint32_t number, const CpuHit& hit) const {
  record(number, landing_of(hit));
  const BvhTriangle& reference = bvh_.triangles[hit.reference];
  const auto layer_at = [&](float y) { return shared::layer_of(y, beam_.layer_base_y, beam_.layers_per_metre, beam_.layers); };
  if (bvh_.copies.empty()) {
    const float y = shared::landing_y(reference.a[1], reference.b[1], reference.c[1], hit.weight_b, hit.weight_c);
    count(reference.counter + 2 * layer_at(y) + hit.lower);
  } else {
    const BvhCopy copy = copy_at(bvh_, hit.copy);
    const shared::CopyTurn turn = turn_of(copy);
    const float a = shared::placed_height(turn, reference.a[1]);
    const float b = shared::placed_height(turn, reference.b[1]);
    const float c = shared::placed_height(turn, reference.c[1]);
    const std::uint32_t bin = layer_at(shared::landing_y(a, b, c, hit.weight_b, hit.weight_c)) - layer_at(std::min({a, b, c}));
    count(copy.first_counter + reference.counter + 2 * bin + hit.lower);
  }
  if (!domain_.periodic) count(shared::counter_met);
}

void LandingCounter::count_ground(std::uint32_t number, const shared::Ray& ray, float t) const {
  const glm::vec2 at = shared::ground_point(ray, t);
  record(number, {domain_.has_soil ? shared::landed_on_ground : shared::left_downwards, 0, at.x, at.y});
  if (domain_.has_soil) {
    count(shared::counter_first_cell + shared::soil_cell(beam_.ground, at));
  } else {
    count(shared::counter_transmitted);
  }
  if (!domain_.periodic) count(shared::counter_met);
}

}  // namespace sunfleck

#include "tracers/cpu_tracer.h"

#include "base/check.h"
#include "shared/beam.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <bit>
#include <limits>

namespace sunfleck {
namespace {

// Rays between two questions whether to stop: a fraction of a second.
constexpr std::uint32_t rays_per_slice = 1U << 18U;

glm::vec3 corner(const std::array<float, 3>& at) {
  return {at[0], at[1], at[2]};
}

void count(std::span<std::uint32_t> counters, std::size_t word) {
  std::atomic_ref<std::uint32_t>(counters[word]).fetch_add(1, std::memory_order_relaxed);
}

// Keeps the better of `best` and the hit on one reference.
void meet(const Bvh& bvh, std::uint32_t triangle, const shared::Ray& ray, float limit, OwnElement own, CpuHit& best) {
  const BvhTriangle& reference = bvh.triangles[triangle];
  if (reference.element == own.element && reference.image == own.image) return;
  const shared::TriangleHit hit = shared::meet_triangle(ray, corner(reference.a), corner(reference.b), corner(reference.c));
  if (!hit.met || hit.t > limit) return;
  if (!shared::hit_precedes({hit.t, reference.element, triangle}, {best.t, best.element, best.triangle})) return;
  best = {true, hit.t, hit.weight_b, hit.weight_c, hit.lower, reference.element, triangle};
}

CpuHit no_hit(float limit) {
  CpuHit best;
  best.t = limit;
  best.element = std::numeric_limits<std::uint32_t>::max();
  return best;
}

// The planes of a node's children that a ray reaches first and last, by the signs of its direction.
struct NodePlanes {
  const std::uint8_t* near[3];
  const std::uint8_t* far[3];
};

NodePlanes planes_along(const BvhNode& node, const std::array<bool, 3>& back) {
  return {{back[0] ? node.hi_x.data() : node.lo_x.data(), back[1] ? node.hi_y.data() : node.lo_y.data(),
           back[2] ? node.hi_z.data() : node.lo_z.data()},
          {back[0] ? node.lo_x.data() : node.hi_x.data(), back[1] ? node.lo_y.data() : node.hi_y.data(),
           back[2] ? node.lo_z.data() : node.hi_z.data()}};
}

// Per child slot where the ray enters its box; infinity where it misses the box before `limit`.
std::array<float, 8> enter_children(const BvhNode& node, const shared::Ray& ray, const std::array<bool, 3>& back, float limit) {
  const NodePlanes planes = planes_along(node, back);
  const float origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
  const float inverse[3] = {ray.inverse.x, ray.inverse.y, ray.inverse.z};
  std::array<float, 8> enter{};
  std::array<float, 8> leave;
  leave.fill(limit);
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = std::bit_cast<float>(std::uint32_t{node.exponent[axis]} << 23U) * inverse[axis];
    const float base = (node.origin[axis] - origin[axis]) * inverse[axis];
    for (std::size_t k = 0; k < 8; ++k) {
      const float first = static_cast<float>(planes.near[axis][k]) * scale + base;
      const float last = static_cast<float>(planes.far[axis][k]) * scale + base;
      enter[k] = first > enter[k] ? first : enter[k];
      leave[k] = last < leave[k] ? last : leave[k];
    }
  }
  for (std::size_t k = 0; k < 8; ++k) {
    if (enter[k] > leave[k]) enter[k] = std::numeric_limits<float>::infinity();
  }
  return enter;
}

struct Visit {
  std::uint32_t node;
  float enter;
};

}  // namespace

CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own) {
  CpuHit best = no_hit(limit);
  for (std::uint32_t triangle = 0; triangle < bvh.triangles.size(); ++triangle) meet(bvh, triangle, ray, limit, own, best);
  return best;
}

CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images, OwnElement own) {
  CpuHit best = no_hit(limit);
  if (bvh.nodes.empty()) return best;
  const std::array<bool, 3> back{ray.inverse.x < 0.0F, ray.inverse.y < 0.0F, ray.inverse.z < 0.0F};
  const unsigned octant = (back[0] ? 4U : 0U) | (back[1] ? 2U : 0U) | (back[2] ? 1U : 0U);
  std::array<Visit, 8 * max_bvh_depth> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, 0.0F};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.enter > best.t) continue;
    const BvhNode& node = bvh.nodes[visit.node];
    const std::array<float, 8> enter = enter_children(node, ray, back, best.t);
    for (unsigned order = 0; order < 8; ++order) {  // the last one pushed is visited first
      const unsigned slot = order ^ octant;
      if (enter[slot] > best.t || node.meta[slot] == 0) continue;
      if ((node.inner_mask >> slot & 1U) != 0) {
        const auto below = static_cast<unsigned>(std::popcount(node.inner_mask & ((1U << slot) - 1U)));
        DCHECK(depth, <, stack.size());
        stack[depth++] = {node.child_base + below, enter[slot]};
        continue;
      }
      const std::uint32_t first = node.triangle_base + (node.meta[slot] & 31U);
      const auto triangles = static_cast<std::uint32_t>(std::popcount(static_cast<unsigned>(node.meta[slot] >> 5U)));
      for (std::uint32_t k = first; k < first + triangles; ++k) {
        if (images == Images::all || bvh.triangles[k].image == 0) meet(bvh, k, ray, limit, own, best);
      }
    }
  }
  return best;
}

TracerDevice CpuTracer::device() const {
  return {"cpu", walk_ == CpuWalk::tree ? "CPU path" : "CPU path, every element tested", "", true};
}

CpuHit CpuTracer::nearest(const shared::Ray& ray, float limit, OwnElement own) const {
  return walk_ == CpuWalk::tree ? nearest_hit(bvh_, ray, limit, Images::all, own) : nearest_hit_of_all(bvh_, ray, limit, own);
}

void CpuTracer::count_element(const shared::BeamBlock& beam, const CpuHit& hit, std::span<std::uint32_t> counters) const {
  const BvhTriangle& reference = bvh_.triangles[hit.triangle];
  const float y = shared::landing_y(reference.a[1], reference.b[1], reference.c[1], hit.weight_b, hit.weight_c);
  const std::uint32_t layer = shared::layer_of(y, beam.layer_base_y, beam.layers_per_metre, beam.layers);
  count(counters, reference.counter + 2 * layer + hit.lower);
  if (!scene_.periodic) count(counters, shared::counter_met);
}

void CpuTracer::count_ground(const shared::BeamBlock& beam, const shared::Ray& ray, float t,
                             std::span<std::uint32_t> counters) const {
  if (scene_.has_soil) {
    count(counters, shared::counter_first_cell + shared::soil_cell(beam.ground, shared::ground_point(ray, t)));
  } else {
    count(counters, shared::counter_transmitted);
  }
  if (!scene_.periodic) count(counters, shared::counter_met);
}

void CpuTracer::follow_in_isolated_stand(const shared::BeamBlock& beam, const shared::Ray& ray,
                                         std::span<std::uint32_t> counters) const {
  const shared::Ground ground = shared::meet_ground(ray, beam.ground);
  const bool over_plot = shared::in_plot(beam.ground, shared::ground_point(ray, ground.t));
  const CpuHit hit = nearest(ray, over_plot ? ground.limit : 1e30F);
  if (hit.found) {
    count_element(beam, hit, counters);
  } else if (over_plot) {
    count_ground(beam, ray, ground.t, counters);
  } else {
    count(counters, shared::counter_missed);
  }
}

void CpuTracer::follow_in_endless_canopy(const shared::BeamBlock& beam, shared::Ray ray, std::uint32_t crossings,
                                         std::span<std::uint32_t> counters) const {
  while (true) {
    const shared::Ground ground = shared::meet_ground(ray, beam.ground);
    const shared::Crossing crossing = shared::next_crossing(ray, beam.period, beam.overlap);
    const CpuHit hit = nearest(ray, ground.limit < crossing.limit ? ground.limit : crossing.limit);
    if (hit.found) return count_element(beam, hit, counters);
    if (ground.t <= crossing.t) return count_ground(beam, ray, ground.t, counters);
    if (++crossings > shared::max_crossings) return count(counters, shared::counter_lost);
    ray.origin = shared::enter_next_period(ray, crossing, beam.period);
  }
}

void CpuTracer::finish_ray(const shared::BeamBlock& beam, const shared::PausedRay& paused,
                           std::span<std::uint32_t> counters) const {
  const shared::Ray ray = shared::make_ray(paused.origin, beam.direction);
  if (scene_.periodic) {
    follow_in_endless_canopy(beam, ray, paused.crossings, counters);
  } else {
    follow_in_isolated_stand(beam, ray, counters);
  }
}

TraceOutcome CpuTracer::count_beam(const shared::BeamBlock& beam, std::span<std::uint32_t> counters, const StopQuestion& stop) {
  const std::uint32_t rays = beam.columns * beam.rows;
  for (std::uint32_t first = 0; first < rays; first += rays_per_slice) {
    if (stop && stop()) return TraceOutcome::stopped;
    const std::uint32_t end = rays - first < rays_per_slice ? rays : first + rays_per_slice;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, end, 256), [&](const auto& range) {
      for (std::uint32_t ray = range.begin(); ray < range.end(); ++ray) {
        finish_ray(beam, {shared::beam_origin(beam, ray), 0, ray, 0}, counters);
      }
    });
  }
  return TraceOutcome::finished;
}

struct CpuThreads::Limit {
  tbb::global_control control;
};

CpuThreads::CpuThreads(int threads)
    : limit_(
          new Limit{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency()))}) {}

CpuThreads::~CpuThreads() = default;

}  // namespace sunfleck

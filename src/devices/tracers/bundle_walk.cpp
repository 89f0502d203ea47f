#include "devices/tracers/bundle_walk.h"

#include <algorithm>
#include <span>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "devices/tracers/bundle_walk.cpp"
#include <hwy/foreach_target.h>

#include "devices/tracers/walk_vectors.h"

HWY_BEFORE_NAMESPACE();
namespace sunfleck::HWY_NAMESPACE {

using namespace walk_parts;
using namespace walk_parts::HWY_NAMESPACE;

// The bundle as shared::meet_triangle sees its rays, side by side.
struct EdgeRays {
  EdgeAxes axes;
  float shear_x, shear_y;
  std::uint32_t rays;
  unsigned exist;  // bit k: ray k exists
  alignas(64) float origin_x[rays_per_bundle];
  alignas(64) float origin_y[rays_per_bundle];
  alignas(64) float origin_z[rays_per_bundle];
};

HWY_INLINE EdgeRays edge_rays(const RayBundle& bundle) {
  EdgeRays result;
  result.axes = edge_axes(bundle.along);
  result.shear_x = bundle.along.shear.x;
  result.shear_y = bundle.along.shear.y;
  result.rays = bundle.rays;
  result.exist = (1U << bundle.rays) - 1U;
  for (std::uint32_t lane = 0; lane < rays_per_bundle; ++lane) {
    const glm::vec3& at = bundle.origins[std::min(lane, bundle.rays - 1)];
    const float origin[3] = {at.x, at.y, at.z};
    result.origin_x[lane] = origin[result.axes.x];
    result.origin_y[lane] = origin[result.axes.y];
    result.origin_z[lane] = origin[result.axes.z];
  }
  return result;
}

// Returns the bits of the rays that are not outside the edges.
HWY_INLINE unsigned within_edges(const EdgeRays& rays, const BvhTriangle& triangle) {
  const hn::CappedTag<float, rays_per_bundle> lanes;
  const auto shear_x = hn::Set(lanes, rays.shear_x);
  const auto shear_y = hn::Set(lanes, rays.shear_y);
  unsigned outside = 0;
  for (std::size_t i = 0; i < rays.rays; i += hn::Lanes(lanes)) {
    outside |= outside_edges(lanes, rays.axes, triangle, hn::Load(lanes, rays.origin_x + i), hn::Load(lanes, rays.origin_y + i),
                             hn::Load(lanes, rays.origin_z + i), shear_x, shear_y)
               << i;
  }
  return rays.exist & ~outside;
}

// The origins that rays of the bundle may have along each axis: the one furthest along the rays, from which a box is reached
// first, and the one furthest behind. Since rounding is monotonic and each step is that for one ray, enter_children leaves out
// no slot that one of the rays would enter by itself.
struct BoxRays {
  PointLanes foremost, hindmost;
};

HWY_INLINE BoxRays box_rays(const RayBundle& bundle, const BoxPath& path) {
  BoxRays result{lanes_of({}), lanes_of({})};
  for (unsigned axis = 0; axis < 3; ++axis) {
    float lo = bundle.origins[0][static_cast<int>(axis)];
    float hi = lo;
    for (std::uint32_t ray = 1; ray < bundle.rays; ++ray) {
      lo = std::min(lo, bundle.origins[ray][static_cast<int>(axis)]);
      hi = std::max(hi, bundle.origins[ray][static_cast<int>(axis)]);
    }
    result.foremost.at[axis] = path.back[axis] ? lo : hi;
    result.hindmost.at[axis] = path.back[axis] ? hi : lo;
  }
  return result;
}

// Returns how far the ray that can still gain most looks.
HWY_INLINE float furthest(std::span<const CpuHit> hits) {
  float result = hits[0].t;
  for (const CpuHit& hit : hits) result = std::max(result, hit.t);
  return result;
}

// Walks the tree below `root`; `limit` is always furthest(hits). A tree of copies calls enter_copy(node number) for each copy
// that a ray may meet.
template <bool of_copies, class EnterCopy>
HWY_INLINE void walk(const Bvh& bvh, std::uint32_t root, const RayBundle& bundle, const Numbering& add, std::span<CpuHit> hits,
                     float& limit, const EnterCopy& enter_copy) {
  const BoxPath path = box_path(bundle.along);
  const BoxRays boxes = box_rays(bundle, path);
  const EdgeRays edges = edge_rays(bundle);
  VisitStack stack;
  std::uint32_t at = root;
  do {
    const BvhNode& node = bvh.nodes[at];
    if constexpr (of_copies) {
      if (is_copy(node)) {
        enter_copy(at);
        continue;
      }
    }
    const std::uint32_t met = enter_children(node, path, boxes.foremost, boxes.hindmost, limit, stack.next().enter);
    for_triangles(node, met, [&](std::uint32_t triangle) HWY_ATTR {
      unsigned within = within_edges(edges, bvh.triangles[triangle]);
      if (within == 0) return;
      for (; within != 0; within &= within - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(within));
        shared::Ray ray = bundle.along;
        ray.origin = bundle.origins[lane];
        meet(bvh, triangle, ray, bundle.limits[lane], bundle.own[lane], add, hits[lane]);
      }
      limit = furthest(hits);
    });
    stack.push(node, met, path.nearest);
  } while (stack.pop(path.nearest, limit, 0, at));
}

// Returns the bundle in the frame of a copy's mesh, as shared::turned_ray turns each of its rays.
RayBundle turned_bundle(const shared::CopyTurn& turn, const RayBundle& bundle) {
  RayBundle turned = bundle;
  turned.along = shared::turned_ray(turn, bundle.along);
  for (std::uint32_t ray = 0; ray < bundle.rays; ++ray) {
    turned.origins[ray] = shared::turned_back(turn, bundle.origins[ray] - turn.shift);
  }
  return turned;
}

void nearest_hits(const Bvh& bvh, const RayBundle& bundle, BundleHits& hits) {
  const std::span<CpuHit> best(hits.data(), bundle.rays);
  for (std::uint32_t ray = 0; ray < bundle.rays; ++ray) best[ray] = no_hit(bundle.limits[ray]);
  if (bvh.nodes.empty() || best.empty()) return;
  float limit = furthest(best);
  const auto no_copies = [](std::uint32_t) {};
  if (bvh.copies.empty()) return walk<false>(bvh, 0, bundle, {}, best, limit, no_copies);
  walk<true>(bvh, 0, bundle, {}, best, limit, [&](std::uint32_t node) HWY_ATTR {
    const BvhCopy copy = copy_at(bvh, node);
    walk<false>(bvh, copy.root, turned_bundle(turn_of(copy), bundle), numbering_of(copy, node), best, limit, no_copies);
  });
}

}  // namespace sunfleck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {

HWY_EXPORT(nearest_hits);

void nearest_hits(const Bvh& bvh, const RayBundle& bundle, BundleHits& hits) {
  HWY_DYNAMIC_DISPATCH(nearest_hits)(bvh, bundle, hits);
}

}  // namespace sunfleck
#endif

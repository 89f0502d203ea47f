#include "devices/tracers/bundle_walk.h"

#include "devices/tracers/walk_parts.h"

#include <algorithm>
#include <span>
#include <utility>

namespace sunfleck {
namespace {

using namespace walk_parts;

constexpr std::uint32_t ray_groups = rays_per_bundle / 8;

// The bundle as shared::meet_triangle sees its rays, eight to a vector, with the axes already in order.
struct EdgeRays {
  std::size_t x, y, z;
  float shear_x, shear_y;
  std::uint32_t groups;  // that hold rays
  unsigned rays;         // bit k: ray k exists
  Float8 origin_x[ray_groups], origin_y[ray_groups], origin_z[ray_groups];
};

INLINED EdgeRays edge_rays(const RayBundle& bundle) {
  EdgeRays result;
  result.z = bundle.along.axis;
  result.x = result.z == 2 ? 0 : result.z + 1;
  result.y = result.x == 2 ? 0 : result.x + 1;
  result.shear_x = bundle.along.shear.x;
  result.shear_y = bundle.along.shear.y;
  result.groups = (bundle.rays + 7) / 8;
  result.rays = (1U << bundle.rays) - 1U;
  for (std::uint32_t lane = 0; lane < 8 * result.groups; ++lane) {
    const glm::vec3& at = bundle.origins[std::min(lane, bundle.rays - 1)];
    const float origin[3] = {at.x, at.y, at.z};
    result.origin_x[lane / 8][lane % 8] = origin[result.x];
    result.origin_y[lane / 8][lane % 8] = origin[result.y];
    result.origin_z[lane / 8][lane % 8] = origin[result.z];
  }
  return result;
}

// Returns the bits of the rays that are not outside the edges: computes u, v and w as shared::meet_triangle does.
INLINED unsigned within_edges(const EdgeRays& rays, const BvhTriangle& t) {
  unsigned within = 0;
  for (std::uint32_t group = 0; group < rays.groups; ++group) {
    const Float8 az = t.a[rays.z] - rays.origin_z[group];
    const Float8 bz = t.b[rays.z] - rays.origin_z[group];
    const Float8 cz = t.c[rays.z] - rays.origin_z[group];
    const Float8 ax = t.a[rays.x] - rays.origin_x[group] - rays.shear_x * az;
    const Float8 ay = t.a[rays.y] - rays.origin_y[group] - rays.shear_y * az;
    const Float8 bx = t.b[rays.x] - rays.origin_x[group] - rays.shear_x * bz;
    const Float8 by = t.b[rays.y] - rays.origin_y[group] - rays.shear_y * bz;
    const Float8 cx = t.c[rays.x] - rays.origin_x[group] - rays.shear_x * cz;
    const Float8 cy = t.c[rays.y] - rays.origin_y[group] - rays.shear_y * cz;
    const Float8 u = cx * by - cy * bx;
    const Float8 v = ax * cy - ay * cx;
    const Float8 w = bx * ay - by * ax;
    const Int8 outside = ((u < 0.0F) | (v < 0.0F) | (w < 0.0F)) & ((u > 0.0F) | (v > 0.0F) | (w > 0.0F));
    within |= bits_of(~outside) << (8 * group);
  }
  return within & rays.rays;
}

// The origins that rays of the bundle may have along each axis: the one furthest along the rays, from which a box is reached first,
// and the one furthest behind. Since rounding is monotonic and each step is that for one ray, enter_children leaves out no slot that
// one of the rays would enter by itself.
struct BoxRays {
  float foremost[3];
  float hindmost[3];
};

INLINED BoxRays box_rays(const RayBundle& bundle, const BoxPath& path) {
  BoxRays result;
  for (int axis = 0; axis < 3; ++axis) {
    float lo = bundle.origins[0][axis];
    float hi = lo;
    for (std::uint32_t ray = 1; ray < bundle.rays; ++ray) {
      lo = std::min(lo, bundle.origins[ray][axis]);
      hi = std::max(hi, bundle.origins[ray][axis]);
    }
    result.foremost[axis] = path.back[axis] ? lo : hi;
    result.hindmost[axis] = path.back[axis] ? hi : lo;
  }
  return result;
}

// Returns how far the ray that can still gain most looks.
INLINED float furthest(std::span<const CpuHit> hits) {
  float result = hits[0].t;
  for (const CpuHit& hit : hits) result = std::max(result, hit.t);
  return result;
}

// Walks the tree below `root`; `limit` is always furthest(hits). A tree of copies calls enter_copy(node number) for each copy that
// a ray may meet.
template <bool of_copies, class EnterCopy>
INLINED void walk(const Bvh& bvh, std::uint32_t root, const RayBundle& bundle, const Numbering& add, std::span<CpuHit> hits,
                  float& limit, const EnterCopy& enter_copy) {
  const BoxPath path = box_path(bundle.along);
  const BoxRays boxes = box_rays(bundle, path);
  const EdgeRays edges = edge_rays(bundle);
  VisitStack stack;
  std::size_t depth = 0;
  stack[depth++] = {root, 0.0F};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.enter > limit) continue;
    const BvhNode& node = bvh.nodes[visit.node];
    if constexpr (of_copies) {
      if (is_copy(node)) {
        enter_copy(visit.node);
        continue;
      }
    }
    Float8 enter;
    const unsigned met = enter_children(node, path, boxes.foremost, boxes.hindmost, limit, enter);
    for_triangles(
        node, met, path.octant, [&](std::uint32_t triangle) __attribute__((always_inline)) {
          unsigned within = within_edges(edges, bvh.triangles[triangle]);
          if (within == 0) return;
          for (; within != 0; within &= within - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(within));
            shared::Ray ray = bundle.along;
            ray.origin = bundle.origins[lane];
            meet(bvh, triangle, ray, bundle.limits[lane], {}, add, hits[lane]);
          }
          limit = furthest(hits);
        });
    push_inner(node, met, path.octant, enter, limit, stack, depth);
  }
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

}  // namespace

WALK_FOR_EACH_PROCESSOR
void nearest_hits(const Bvh& bvh, const RayBundle& bundle, BundleHits& hits) {
  const std::span<CpuHit> best(hits.data(), bundle.rays);
  for (std::uint32_t ray = 0; ray < bundle.rays; ++ray) best[ray] = no_hit(bundle.limits[ray]);
  if (bvh.nodes.empty() || best.empty()) return;
  float limit = furthest(best);
  const auto no_copies = [](std::uint32_t) {};
  if (bvh.copies.empty()) return walk<false>(bvh, 0, bundle, {}, best, limit, no_copies);
  walk<true>(
      bvh, 0, bundle, {}, best, limit, [&](std::uint32_t node) __attribute__((always_inline)) {
        const BvhCopy copy = copy_at(bvh, node);
        walk<false>(bvh, copy.root, turned_bundle(turn_of(copy), bundle), numbering_of(copy, node), best, limit, no_copies);
      });
}

}  // namespace sunfleck

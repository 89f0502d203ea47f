#include "devices/tracers/cpu_walk.h"

#include "devices/tracers/walk_parts.h"

namespace sunfleck {
namespace {

using namespace walk_parts;

// Walks the tree below `root`. A tree of copies calls enter_copy(node number) for each copy that the ray may meet.
template <bool of_copies, class EnterCopy>
INLINED void walk(const Bvh& bvh, std::uint32_t root, const shared::Ray& ray, float limit, Images images, OwnElement own,
                  const Numbering& add, CpuHit& best, const EnterCopy& enter_copy) {
  const BoxPath path = box_path(ray);
  const float origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
  const EdgeRay edges = edge_ray(ray);
  VisitStack stack;
  std::size_t depth = 0;
  stack[depth++] = {root, 0.0F};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.enter > best.t) continue;
    const BvhNode& node = bvh.nodes[visit.node];
    if constexpr (of_copies) {
      if (is_copy(node)) {
        enter_copy(visit.node);
        continue;
      }
    }
    Float8 enter;
    const unsigned met = enter_children(node, path, origin, origin, best.t, enter);
    for_triangles(
        node, met, path.octant, [&](std::uint32_t triangle) __attribute__((always_inline)) {
          const BvhTriangle& reference = bvh.triangles[triangle];
          if (!within_edges(edges, reference)) return;
          if (images == Images::all || reference.image == 0) meet(bvh, triangle, ray, limit, own, add, best);
        });
    push_inner(node, met, path.octant, enter, best.t, stack, depth);
  }
}

}  // namespace

shared::CopyTurn turn_of(const BvhCopy& copy) {
  return {corner(copy.shift), copy.cos_out, copy.sin_out, copy.scale, copy.cos_back, copy.sin_back, copy.per_scale};
}

CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own) {
  CpuHit best = no_hit(limit);
  for (const std::uint32_t node : bvh.copies) {
    const BvhCopy copy = copy_at(bvh, node);
    const shared::Ray turned = shared::turned_ray(turn_of(copy), ray);
    for (std::uint32_t k = copy.first_triangle; k < copy.first_triangle + copy.triangles; ++k) {
      meet(bvh, k, turned, limit, own, numbering_of(copy, node), best);
    }
  }
  if (!bvh.copies.empty()) return best;
  for (std::uint32_t k = 0; k < bvh.triangles.size(); ++k) meet(bvh, k, ray, limit, own, {}, best);
  return best;
}

WALK_FOR_EACH_PROCESSOR
CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images, OwnElement own) {
  CpuHit best = no_hit(limit);
  if (bvh.nodes.empty()) return best;
  const auto no_copies = [](std::uint32_t) {};
  if (bvh.copies.empty()) {
    walk<false>(bvh, 0, ray, limit, images, own, {}, best, no_copies);
    return best;
  }
  walk<true>(
      bvh, 0, ray, limit, images, own, {}, best, [&](std::uint32_t node) __attribute__((always_inline)) {
        const BvhCopy copy = copy_at(bvh, node);
        if (images == Images::originals && copy.image != 0) return;
        walk<false>(bvh, copy.root, shared::turned_ray(turn_of(copy), ray), limit, images, own, numbering_of(copy, node), best,
                    no_copies);
      });
  return best;
}

}  // namespace sunfleck

#include "devices/tracers/cpu_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "devices/tracers/cpu_walk.cpp"
#include <hwy/foreach_target.h>

#include "devices/tracers/walk_vectors.h"

HWY_BEFORE_NAMESPACE();
namespace sunfleck::HWY_NAMESPACE {

using namespace walk_parts;
using namespace walk_parts::HWY_NAMESPACE;

// Walks the tree below `root`. A tree of copies calls enter_copy(node number) for each copy that the ray may meet.
template <bool of_copies, class EnterCopy>
HWY_INLINE void walk(const Bvh& bvh, std::uint32_t root, const shared::Ray& ray, float limit, Images images, OwnElement own,
                     const Numbering& add, CpuHit& best, const EnterCopy& enter_copy) {
  const BoxPath path = box_path(ray);
  const EdgeRay edges = edge_ray(ray);
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
    const std::uint32_t met = enter_children(node, path, edges.origin, edges.origin, best.t, stack.next().enter);
    for_triangles(node, met, [&](std::uint32_t triangle) HWY_ATTR {
      const BvhTriangle& reference = bvh.triangles[triangle];
      if (!within_edges(edges, reference)) return;
      if (images == Images::all || reference.image == 0) meet(bvh, triangle, ray, limit, own, add, best);
    });
    stack.push(node, met, path.nearest);
  } while (stack.pop(path.nearest, best.t, 0, at));
}

CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images, OwnElement own) {
  CpuHit best = no_hit(limit);
  if (bvh.nodes.empty()) return best;
  const auto no_copies = [](std::uint32_t) {};
  if (bvh.copies.empty()) {
    walk<false>(bvh, 0, ray, limit, images, own, {}, best, no_copies);
    return best;
  }
  walk<true>(bvh, 0, ray, limit, images, own, {}, best, [&](std::uint32_t node) HWY_ATTR {
    const BvhCopy copy = copy_at(bvh, node);
    if (images == Images::originals && copy.image != 0) return;
    walk<false>(bvh, copy.root, shared::turned_ray(turn_of(copy), ray), limit, images, own, numbering_of(copy, node), best,
                no_copies);
  });
  return best;
}

}  // namespace sunfleck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {

HWY_EXPORT(nearest_hit);

CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images, OwnElement own) {
  return HWY_DYNAMIC_DISPATCH(nearest_hit)(bvh, ray, limit, images, own);
}

shared::CopyTurn turn_of(const BvhCopy& copy) {
  return {walk_parts::corner(copy.shift), copy.cos_out, copy.sin_out, copy.scale, copy.cos_back, copy.sin_back, copy.per_scale};
}

CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own) {
  CpuHit best = walk_parts::no_hit(limit);
  for (const std::uint32_t node : bvh.copies) {
    const BvhCopy copy = copy_at(bvh, node);
    const shared::Ray turned = shared::turned_ray(turn_of(copy), ray);
    for (std::uint32_t k = copy.first_triangle; k < copy.first_triangle + copy.triangles; ++k) {
      walk_parts::meet(bvh, k, turned, limit, own, walk_parts::numbering_of(copy, node), best);
    }
  }
  if (!bvh.copies.empty()) return best;
  for (std::uint32_t k = 0; k < bvh.triangles.size(); ++k) walk_parts::meet(bvh, k, ray, limit, own, {}, best);
  return best;
}

}  // namespace sunfleck
#endif

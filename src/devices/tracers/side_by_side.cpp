#include "devices/tracers/side_by_side.h"

#include "devices/tracers/walk_parts.h"

#include <array>

namespace sunfleck {
namespace {

using namespace walk_parts;

// One search on its way.
struct Walker {
  Search search;
  BoxPath path;
  EdgeRay edges;
  CpuHit best;
  bool active = false;
  const BvhNode* node = nullptr;  // whose leaves are still to be tested
  unsigned met = 0;               // slots of its leaves that the ray meets
  std::size_t depth = 0;
  VisitStack stack;
};

// Asks memory for what lies there, so that it has come when the walker's next turn comes.
template <class Part>
INLINED void prefetch(const Part& part) {
  const char* const bytes = reinterpret_cast<const char*>(&part);
  __builtin_prefetch(bytes);
  __builtin_prefetch(bytes + sizeof(Part) - 1);
}

INLINED void begin(const Bvh& bvh, Walker& walker) {
  walker.path = box_path(walker.search.ray);
  walker.edges = edge_ray(walker.search.ray);
  walker.best = no_hit(walker.search.limit);
  walker.node = nullptr;
  walker.met = 0;
  walker.stack[0] = {0, 0.0F};
  walker.depth = bvh.nodes.empty() ? 0 : 1;
}

INLINED void test_leaves(const Bvh& bvh, Walker& walker) {
  for_triangles(
      *walker.node, walker.met, walker.path.octant, [&](std::uint32_t triangle) __attribute__((always_inline)) {
        if (within_edges(walker.edges, bvh.triangles[triangle])) {
          meet(bvh, triangle, walker.search.ray, walker.search.limit, walker.search.own, {}, walker.best);
        }
      });
}

INLINED void prefetch_leaves(const Bvh& bvh, const BvhNode& node, unsigned met) {
  for (; met != 0; met &= met - 1) {
    prefetch(bvh.triangles[node.triangle_base + (node.meta[static_cast<unsigned>(std::countr_zero(met))] & 31U)]);
  }
}

// Tests the leaves of the node before and visits the next one; returns false if there is none.
INLINED bool step(const Bvh& bvh, Walker& walker) {
  if (walker.met != 0) test_leaves(bvh, walker);
  const shared::Ray& ray = walker.search.ray;
  const float origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
  while (walker.depth > 0) {
    const Visit visit = walker.stack[--walker.depth];
    if (visit.enter > walker.best.t) continue;
    const BvhNode& node = bvh.nodes[visit.node];
    Float8 enter;
    const unsigned met = enter_children(node, walker.path, origin, origin, walker.best.t, enter);
    push_inner(node, met, walker.path.octant, enter, walker.best.t, walker.stack, walker.depth);
    walker.node = &node;
    walker.met = met & ~unsigned{node.inner_mask};
    prefetch_leaves(bvh, node, walker.met);
    if (walker.depth > 0) prefetch(bvh.nodes[walker.stack[walker.depth - 1].node]);
    return true;
  }
  return false;
}

}  // namespace

WALK_FOR_EACH_PROCESSOR
void search_side_by_side(const Bvh& bvh, SearchSource& source) {
  EXPECT(bvh.copies.size(), ==, std::size_t{0});
  std::array<Walker, searches_at_once> walkers;
  std::size_t active = 0;
  for (std::size_t slot = 0; slot < walkers.size(); ++slot) {
    Walker& walker = walkers[slot];
    walker.active = source.begin(slot, walker.search);
    if (!walker.active) continue;
    begin(bvh, walker);
    ++active;
  }
  while (active > 0) {
    for (std::size_t slot = 0; slot < walkers.size(); ++slot) {
      Walker& walker = walkers[slot];
      if (!walker.active || step(bvh, walker)) continue;
      walker.active = source.next(slot, walker.best, walker.search);
      if (walker.active) {
        begin(bvh, walker);
      } else {
        --active;
      }
    }
  }
}

}  // namespace sunfleck

#include "devices/tracers/side_by_side.h"

#include "base/prefetch.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "devices/tracers/side_by_side.cpp"
#include <hwy/foreach_target.h>

#include "devices/tracers/walk_vectors.h"

HWY_BEFORE_NAMESPACE();
namespace sunfleck::HWY_NAMESPACE {

using namespace walk_parts;
using namespace walk_parts::HWY_NAMESPACE;

// A node of which no ray meets any child, for a search that only waits for its triangles.
constexpr BvhNode make_node_without_children() {
  BvhNode node{};
  for (auto* const lo : {&node.lo_x, &node.lo_y, &node.lo_z}) lo->fill(255);
  node.exponent.fill(127);
  return node;
}
constexpr BvhNode node_without_children = make_node_without_children();

// One search on its way.
struct Walker {
  Search search;
  CpuHit best;
  const BvhNode* node = nullptr;  // to be visited next
  std::uint32_t met = 0;          // children of that node
  // The ray in the frame of the canopy or of the copy in which it is.
  shared::Ray ray;
  BoxPath path;
  EdgeRay edges;
  Numbering add;
  bool in_copy = false;
  std::uint32_t base = 0;  // levels of the stack that lie outside the copy
  VisitStack stack;
};

// A triangle that a walker's ray may meet.
struct Candidate {
  Walker* walker;
  std::uint32_t triangle;
};

// Goes in rounds, each of which does one thing for all walkers before the next: tests of boxes and of edges do not depend on one
// another then, so that the processor can do several at once, and what branches on them finds them done.
template <bool of_copies>
class Rounds {
 public:
  Rounds(const Bvh& bvh, SearchSource& source) : bvh_(bvh), source_(source) {
    for (std::size_t slot = 0; slot < searches_at_once; ++slot) {
      if (source_.begin(slot, walkers_[slot].search)) active_[actives_++] = &walkers_[slot];
    }
    for (std::size_t k = 0; k < actives_; ++k) begin(*active_[k]);
  }

  void go() {
    while (actives_ > 0) {
      test_boxes();
      test_triangles();
      for (std::size_t k = 0; k < actives_;) {
        if (advance(*active_[k])) {
          ++k;
        } else {
          active_[k] = active_[--actives_];
        }
      }
    }
  }

 private:
  HWY_INLINE void test_boxes() {
    for (std::size_t k = 0; k < actives_; ++k) {
      Walker& walker = *active_[k];
      walker.met = enter_children(*walker.node, walker.path, walker.edges.origin, walker.edges.origin, walker.best.t,
                                  walker.stack.next().enter);
    }
  }

  HWY_INLINE void test_triangles() {
    std::size_t within = 0;
    for (std::size_t k = 0; k < candidates_; ++k) {
      const Candidate candidate = candidate_[k];
      const bool inside = within_edges(candidate.walker->edges, bvh_.triangles[candidate.triangle]);
      candidate_[within] = candidate;
      within += inside ? 1U : 0U;  // without a branch, which the processor would often guess wrong
    }
    for (std::size_t k = 0; k < within; ++k) {
      Walker& walker = *candidate_[k].walker;
      meet(bvh_, candidate_[k].triangle, walker.ray, walker.search.limit, walker.search.own, walker.add, walker.best);
    }
    candidates_ = 0;
  }

  // Takes what the walker met in its node, and finds its next node; returns false if there is no other search.
  HWY_INLINE bool advance(Walker& walker) {
    const std::size_t before = candidates_;
    for_triangles(*walker.node, walker.met, [&](std::uint32_t triangle) HWY_ATTR {
      candidate_[candidates_++] = {&walker, triangle};
      prefetch(bvh_.triangles[triangle]);
    });
    walker.stack.push(*walker.node, walker.met, walker.path.nearest);
    std::uint32_t next = 0;
    while (!walker.stack.pop(walker.path.nearest, walker.best.t, walker.base, next)) {
      if (candidates_ > before) {
        walker.node = &node_without_children;
        return true;
      }
      if (!of_copies || !walker.in_copy) return finish(walker);
      leave_copy(walker);
    }
    go_to(walker, next);
    return true;
  }

  HWY_INLINE void go_to(Walker& walker, std::uint32_t node) {
    walker.node = &bvh_.nodes[node];
    prefetch(*walker.node);
    if constexpr (of_copies) {
      if (is_copy(*walker.node)) enter_copy(walker, node);
    }
  }

  bool finish(Walker& walker) {
    if (!source_.next(static_cast<std::size_t>(&walker - walkers_.data()), walker.best, walker.search)) return false;
    begin(walker);
    return true;
  }

  static void set_ray(Walker& walker, const shared::Ray& ray) {
    walker.ray = ray;
    walker.path = box_path(ray);
    walker.edges = edge_ray(ray);
  }

  void begin(Walker& walker) {
    set_ray(walker, walker.search.ray);
    walker.best = no_hit(walker.search.limit);
    walker.add = {};
    walker.base = 0;
    walker.in_copy = false;
    walker.stack.clear();
    walker.node = &node_without_children;
    if (!bvh_.nodes.empty()) go_to(walker, 0);
  }

  // Nodes above the copies have no triangles, and those in a copy have no copies below them.
  void enter_copy(Walker& walker, std::uint32_t node) {
    const BvhCopy copy = copy_at(bvh_, node);
    set_ray(walker, shared::turned_ray(turn_of(copy), walker.search.ray));
    walker.add = numbering_of(copy, node);
    walker.base = walker.stack.depth();
    walker.in_copy = true;
    walker.node = &bvh_.nodes[copy.root];
    prefetch(*walker.node);
  }

  static void leave_copy(Walker& walker) {
    set_ray(walker, walker.search.ray);
    walker.base = 0;
    walker.in_copy = false;
  }

  const Bvh& bvh_;
  SearchSource& source_;
  std::array<Walker, searches_at_once> walkers_;
  std::array<Walker*, searches_at_once> active_{};
  std::size_t actives_ = 0;
  std::array<Candidate, 24 * searches_at_once> candidate_{};  // a node has up to 24 triangles
  std::size_t candidates_ = 0;
};

void search_side_by_side(const Bvh& bvh, SearchSource& source) {
  if (bvh.copies.empty()) return Rounds<false>(bvh, source).go();
  Rounds<true>(bvh, source).go();
}

}  // namespace sunfleck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {

HWY_EXPORT(search_side_by_side);

void search_side_by_side(const Bvh& bvh, SearchSource& source) {
  HWY_DYNAMIC_DISPATCH(search_side_by_side)(bvh, source);
}

}  // namespace sunfleck
#endif

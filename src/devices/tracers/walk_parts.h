#pragma once
// What the walks for one ray, for many rays and for bundles of rays share: paths through boxes, the stack, the order of children,
// hits. walk_vectors.h adds the parts that are compiled for each kind of processor. For the sources of the walks only.

#include "base/check.h"
#include "devices/tracers/cpu_walk.h"

#include <array>
#include <bit>
#include <cstddef>

namespace sunfleck::walk_parts {

// How rays cross the boxes of all nodes.
struct BoxPath {
  alignas(16) std::array<float, 4> inverse;      // x, y, z, 1
  std::array<std::uint32_t, 3> near_at, far_at;  // where a node keeps the planes that a ray meets first and last, in bytes
  std::array<bool, 3> back;                      // whether the rays travel backwards
  unsigned nearest;                              // the slot of the child roughly nearest: 7 - octant, see BvhNode
};

inline BoxPath box_path(const shared::Ray& ray) {
  BoxPath path{{ray.inverse.x, ray.inverse.y, ray.inverse.z, 1.0F}, {}, {}, {}, 7};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto lo = static_cast<std::uint32_t>(offsetof(BvhNode, lo_x) + 8 * axis);
    const auto hi = static_cast<std::uint32_t>(offsetof(BvhNode, hi_x) + 8 * axis);
    path.back[axis] = path.inverse[axis] < 0.0F;
    path.near_at[axis] = path.back[axis] ? hi : lo;
    path.far_at[axis] = path.back[axis] ? lo : hi;
    if (path.back[axis]) path.nearest ^= 4U >> axis;
  }
  return path;
}

// A point in a vector of four; the last lane is a number with which arithmetic is fast whatever stands beside it in memory.
struct PointLanes {
  alignas(16) std::array<float, 4> at;
};

inline PointLanes lanes_of(const glm::vec3& point) {
  return {{point.x, point.y, point.z, 1.0F}};
}

// The axes in the order in which shared::meet_triangle takes them.
struct EdgeAxes {
  std::size_t x, y, z;
};

inline EdgeAxes edge_axes(const shared::Ray& ray) {
  const std::size_t z = ray.axis;
  const std::size_t x = z == 2 ? 0 : z + 1;
  return {x, x == 2 ? 0 : x + 1, z};
}

// A ray as shared::meet_triangle sees it.
struct EdgeRay {
  PointLanes origin;
  EdgeAxes axes;
  float shear_x, shear_y;
};

inline EdgeRay edge_ray(const shared::Ray& ray) {
  return {lanes_of(ray.origin), edge_axes(ray), ray.shear.x, ray.shear.y};
}

// Masks of slots by the nearest slot and mask, ordered roughly along a ray: bit (k XOR nearest) for slot k.
inline constexpr auto along_ray = [] {
  std::array<std::array<std::uint8_t, 256>, 8> ordered{};
  for (unsigned nearest = 0; nearest < 8; ++nearest) {
    for (unsigned slots = 0; slots < 256; ++slots) {
      for (unsigned k = 0; k < 8; ++k) {
        if ((slots >> k & 1U) != 0) ordered[nearest][slots] |= static_cast<std::uint8_t>(1U << (k ^ nearest));
      }
    }
  }
  return ordered;
}();

// The children that a ray meets in a node, as the bits of BvhNode::meta: triangles, and from first_inner_bit on the slots of
// inner nodes.
inline constexpr unsigned first_inner_bit = 24;
inline constexpr std::uint32_t leaf_bits = (1U << first_inner_bit) - 1U;

// The children of a visited node that are still to be visited.
struct alignas(64) Children {
  std::array<float, 8> enter;  // where the ray enters the slots' boxes
  std::uint32_t child_base;
  std::uint32_t inner_mask;
  std::uint32_t left;  // in the order of along_ray: the nearest has the lowest bit
};

// Children at all levels, those of the nearest nodes last.
class VisitStack {
 public:
  void clear() { depth_ = 0; }
  [[nodiscard]] std::uint32_t depth() const { return depth_; }

  // Adds the inner nodes among the children `met`, where the entries of all slots stand in next().enter.
  void push(const BvhNode& node, std::uint32_t met, unsigned nearest) {
    const std::uint32_t inner = met >> first_inner_bit;
    Children& children = next();
    children.child_base = node.child_base;
    children.inner_mask = node.inner_mask;
    children.left = along_ray[nearest][inner];
    depth_ += inner != 0 ? 1U : 0U;  // without a branch, which the processor would often guess wrong
  }

  // Room for the next node's children.
  [[nodiscard]] Children& next() {
    DCHECK(depth_, <, levels_.size());
    return levels_[depth_];
  }

  // Finds the next node that is entered before `limit`, above the level `base`; returns false if there is none.
  [[nodiscard]] bool pop(unsigned nearest, float limit, std::uint32_t base, std::uint32_t& node) {
    while (depth_ > base) {
      Children& children = levels_[depth_ - 1];
      const unsigned slot = static_cast<unsigned>(std::countr_zero(children.left)) ^ nearest;
      children.left &= children.left - 1;
      depth_ -= children.left == 0 ? 1U : 0U;
      if (children.enter[slot] > limit) continue;
      node = children.child_base + static_cast<std::uint32_t>(std::popcount(children.inner_mask & ((1U << slot) - 1U)));
      return true;
    }
    return false;
  }

 private:
  // A tree of copies has levels above the copies and below them; one more is room for children that are not kept.
  std::array<Children, 2 * max_bvh_depth + 1> levels_;
  std::uint32_t depth_ = 0;
};

// Calls test(triangle number) for each triangle of the leaves among the children `met`.
template <class Test>
void for_triangles(const BvhNode& node, std::uint32_t met, const Test& test) {
  for (std::uint32_t left = met & leaf_bits; left != 0; left &= left - 1) {
    test(node.triangle_base + static_cast<std::uint32_t>(std::countr_zero(left)));
  }
}

inline glm::vec3 corner(const std::array<float, 3>& at) {
  return {at[0], at[1], at[2]};
}

// What to add to the numbers of a triangle; nothing in a tree without copies.
struct Numbering {
  std::uint32_t first_element = 0;
  std::uint32_t image = 0;
  std::uint32_t order_offset = 0;
  std::uint32_t copy = 0;  // node
};

inline Numbering numbering_of(const BvhCopy& copy, std::uint32_t node) {
  return {copy.first_element, copy.image, copy.order_offset, node};
}

// Keeps the better of `best` and the hit on one reference.
inline void meet(const Bvh& bvh, std::uint32_t triangle, const shared::Ray& ray, float limit, OwnElement own,
                 const Numbering& add, CpuHit& best) {
  const BvhTriangle& reference = bvh.triangles[triangle];
  const std::uint32_t element = reference.element + add.first_element;
  if (element == own.element && (reference.image | add.image) == own.image) return;
  const shared::TriangleHit hit = shared::meet_triangle(ray, corner(reference.a), corner(reference.b), corner(reference.c));
  if (!hit.met || hit.t > limit) return;
  const std::uint32_t place = triangle + add.order_offset;
  if (!shared::hit_precedes({hit.t, element, place}, {best.t, best.element, best.triangle})) return;
  best = {true, hit.t, hit.weight_b, hit.weight_c, hit.lower, element, place, triangle, add.copy};
}

inline CpuHit no_hit(float limit) {
  CpuHit best;
  best.t = limit;
  best.element = shared::no_element;
  return best;
}

}  // namespace sunfleck::walk_parts

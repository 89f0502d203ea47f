#pragma once
// Functions shared by the tests of the tree: hand-made canopies, a check of everything that bvh.h promises of a tree, and a
// plain walk in double precision.

#include "physics/bvh/bvh.h"
#include "physics/bvh/decode.h"
#include "physics/bvh/references.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace sunfleck::testing_bvh {

using Random = std::mt19937;

// Returns a number in [0, 1) without the distributions of the standard library, whose numbers differ between implementations.
inline double uniform(Random& random) {
  return static_cast<double>(random()) / 4294967296.0;
}
inline double uniform(Random& random, double lo, double hi) {
  return lo + (hi - lo) * uniform(random);
}
inline glm::vec3 point(Random& random, double half_size) {
  const auto coordinate = [&] { return static_cast<float>(uniform(random, -half_size, half_size)); };
  const float x = coordinate();
  const float y = coordinate();
  return {x, y, coordinate()};
}

inline Canopy isolated(std::vector<Triangle> corners) {
  Canopy canopy;
  canopy.corners = std::move(corners);
  return canopy;
}

inline std::vector<Triangle> scattered(std::size_t count, double spread, double size, unsigned seed) {
  Random random(seed);
  std::vector<Triangle> corners(count);
  for (Triangle& triangle : corners) {
    const glm::vec3 middle = point(random, spread);
    for (glm::vec3& corner : triangle) corner = middle + point(random, size);
  }
  return corners;
}

using Key = std::tuple<std::uint32_t, std::uint32_t>;  // element, packed image

inline std::vector<Key> sorted_keys(const Canopy& canopy) {
  std::vector<Key> keys;
  for (const Reference& r : make_references(canopy)) keys.emplace_back(r.element, pack_image(r.dx, r.dz));
  std::sort(keys.begin(), keys.end());
  return keys;
}

inline glm::dvec3 corner(const std::array<float, 3>& a) {
  return {a[0], a[1], a[2]};
}

struct DoubleBox {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

  void grow(const glm::dvec3& low, const glm::dvec3& high) {
    lo = glm::min(lo, low);
    hi = glm::max(hi, high);
  }
  [[nodiscard]] bool holds(const DoubleBox& other) const {
    return glm::min(lo, other.lo) == lo && glm::max(hi, other.hi) == hi;
  }
  [[nodiscard]] double half_area() const {
    const glm::dvec3 size = hi - lo;
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

// Returns the child's box in exact arithmetic; doubles hold every coordinate.
inline DoubleBox exact_child_box(const BvhNode& node, std::size_t k) {
  DoubleBox box;
  const std::array lo = {node.lo_x[k], node.lo_y[k], node.lo_z[k]};
  const std::array hi = {node.hi_x[k], node.hi_y[k], node.hi_z[k]};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    box.lo[axis] = node.origin[i] + std::ldexp(lo[i], node.exponent[i] - 127);
    box.hi[axis] = node.origin[i] + std::ldexp(hi[i], node.exponent[i] - 127);
  }
  return box;
}

// Walks a whole tree, checks everything that bvh.h promises of it, and adds up its cost over unrounded boxes.
class Inspector {
 public:
  Inspector(const Canopy& canopy, const Bvh& bvh, double padding_m) : bvh_(bvh), padding_m_(padding_m) {
    node_seen_.resize(bvh.nodes.size());
    if (!bvh.nodes.empty()) root_ = inspect(0, 1);
    std::sort(keys_.begin(), keys_.end());
    EXPECT_EQ(keys_, sorted_keys(canopy));
    EXPECT_EQ(bvh.triangles.size(), keys_.size());
    EXPECT_EQ(std::count(node_seen_.begin(), node_seen_.end(), 1), static_cast<std::ptrdiff_t>(bvh.nodes.size()));
    EXPECT_EQ(bvh.depth, deepest_);
    EXPECT_LE(bvh.depth, max_bvh_depth);
    EXPECT_EQ(broken_, 0);
  }
  [[nodiscard]] double area_of_nodes() const { return area_of_nodes_; }
  [[nodiscard]] double area_of_triangles() const { return area_of_triangles_; }

 private:
  DoubleBox inspect(std::size_t number, int level) {
    ++node_seen_.at(number);
    deepest_ = std::max(deepest_, level);
    const BvhNode& node = bvh_.nodes.at(number);
    DoubleBox all;
    std::size_t next_child = node.child_base;
    std::size_t next_triangle = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const unsigned meta = node.meta[k];
      const bool inner = ((node.inner_mask >> k) & 1) != 0;
      const DoubleBox exact = exact_child_box(node, k);
      if (meta == 0) {
        require(!inner && glm::max(exact.lo, exact.hi) == exact.lo && exact.lo.x > exact.hi.x && exact.lo.y > exact.hi.y);
        continue;
      }
      DoubleBox held;
      if (inner) {
        require(meta == (32U | (24U + k)));
        held = inspect(next_child++, level + 1);
      } else {
        const unsigned unary = meta >> 5U;
        require((unary == 1 || unary == 3 || unary == 7) && (meta & 31U) == next_triangle);
        held = leaf(node.triangle_base + next_triangle, static_cast<std::size_t>(std::popcount(unary)));
        next_triangle += static_cast<std::size_t>(std::popcount(unary));
      }
      const Box decoded = child_box(node, static_cast<int>(k));
      require(exact.holds(held) && DoubleBox{decoded.lo, decoded.hi}.holds(held));
      all.grow(held.lo, held.hi);
    }
    area_of_nodes_ += all.half_area();
    return all;
  }

  DoubleBox leaf(std::size_t first, std::size_t count) {
    DoubleBox box;
    for (std::size_t i = first; i < first + count; ++i) {
      const BvhTriangle& t = bvh_.triangles.at(i);
      keys_.emplace_back(t.element, t.image);
      require(t.counter == 0);
      for (const auto& p : {corner(t.a), corner(t.b), corner(t.c)}) box.grow(p - padding_m_, p + padding_m_);
    }
    area_of_triangles_ += static_cast<double>(count) * box.half_area();
    return box;
  }

  void require(bool promise) { broken_ += promise ? 0 : 1; }

  const Bvh& bvh_;
  double padding_m_;
  DoubleBox root_;
  std::vector<int> node_seen_;
  std::vector<Key> keys_;
  int deepest_ = 0;
  int broken_ = 0;
  double area_of_nodes_ = 0.0;
  double area_of_triangles_ = 0.0;
};

struct BvhStatistics {
  // Expected node visits + triangle tests per ray that meets the root box; all nodes and triangles if that box has no area.
  double sah_cost = 0.0;
  std::size_t inner_children = 0;
  std::size_t leaf_children = 0;
};

// Returns the figures of a whole tree.
inline BvhStatistics statistics(const Bvh& bvh) {
  BvhStatistics result;
  if (bvh.nodes.empty()) return result;
  DoubleBox root;
  double area_of_visits = 0.0;
  for (const BvhNode& node : bvh.nodes) {
    for (std::size_t k = 0; k < 8; ++k) {
      const unsigned meta = node.meta[k];
      if (meta == 0) continue;
      const bool inner = ((node.inner_mask >> k) & 1) != 0;
      const Box decoded = child_box(node, static_cast<int>(k));
      const DoubleBox box{decoded.lo, decoded.hi};
      const int visits = inner ? 1 : std::popcount(meta >> 5U);
      area_of_visits += visits * box.half_area();
      ++(inner ? result.inner_children : result.leaf_children);
      if (&node == &bvh.nodes.front()) root.grow(box.lo, box.hi);
    }
  }
  const double root_area = root.half_area();
  result.sah_cost =
      root_area > 0.0 ? 1.0 + area_of_visits / root_area : static_cast<double>(bvh.nodes.size() + bvh.triangles.size());
  return result;
}

struct Line {
  glm::dvec3 origin, direction;
};

inline bool meets(const Line& line, const DoubleBox& box, double t_min) {
  double enter = t_min;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (line.direction[axis] == 0.0) {
      if (line.origin[axis] < box.lo[axis] || line.origin[axis] > box.hi[axis]) return false;
      continue;
    }
    const double a = (box.lo[axis] - line.origin[axis]) / line.direction[axis];
    const double b = (box.hi[axis] - line.origin[axis]) / line.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

// Tests a ray against a triangle, edges included (Moeller & Trumbore 1997).
inline bool hits(const Line& ray, const BvhTriangle& triangle) {
  const glm::dvec3 ab = corner(triangle.b) - corner(triangle.a);
  const glm::dvec3 ac = corner(triangle.c) - corner(triangle.a);
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double det = glm::dot(ab, p);
  if (det == 0.0) return false;
  const glm::dvec3 s = ray.origin - corner(triangle.a);
  const double u = glm::dot(s, p) / det;
  const glm::dvec3 q = glm::cross(s, ab);
  const double v = glm::dot(ray.direction, q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, q) / det >= 0.0;
}

struct Visits {
  std::size_t nodes = 0;
  std::vector<std::size_t> triangles;
};

inline void walk(const Bvh& bvh, const Line& line, double t_min, std::size_t number, Visits& visits) {
  ++visits.nodes;
  const BvhNode& node = bvh.nodes[number];
  std::size_t next_child = node.child_base;
  for (std::size_t k = 0; k < 8; ++k) {
    const bool inner = ((node.inner_mask >> k) & 1) != 0;
    const std::size_t child = inner ? next_child++ : 0;
    const Box box = child_box(node, static_cast<int>(k));
    if (!meets(line, {box.lo, box.hi}, t_min)) continue;
    if (inner) walk(bvh, line, t_min, child, visits);
    const std::size_t count = inner ? 0 : static_cast<std::size_t>(std::popcount(static_cast<unsigned>(node.meta[k]) >> 5U));
    for (std::size_t i = 0; i < count; ++i) visits.triangles.push_back(node.triangle_base + (node.meta[k] & 31U) + i);
  }
}

}  // namespace sunfleck::testing_bvh

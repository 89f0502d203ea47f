#pragma once
// Inside bvh only: the binary tree that stands between the builder (build.cpp) and the collapse to eight children
// (collapse.cpp). 64 bytes a reference in all, so that ten million references build in less than a gigabyte.

#include "bvh/bvh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck::detail {

// Four floats in one register; `a < b ? a : b` picks lane by lane. Lane 3 rides along.
using Float4 [[gnu::vector_size(16)]] = float;

// Largest coordinate a tree is built over, m: areas stay far inside single precision.
inline constexpr float largest_coordinate_m = 1e15F;

struct Bounds {
  Float4 lo, hi;

  void grow(const Bounds& other) {
    lo = lo < other.lo ? lo : other.lo;
    hi = hi > other.hi ? hi : other.hi;
  }
  void grow(Float4 point) { grow(Bounds{point, point}); }
  [[nodiscard]] float half_area() const {
    const Float4 size = hi - lo;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

// Grows into whatever it meets; its half_area() is finite.
inline constexpr Bounds nothing{Float4{1e15F, 1e15F, 1e15F, 1e15F}, Float4{-1e15F, -1e15F, -1e15F, -1e15F}};

// The padded box of a reference. Lane 3 of lo and hi carries the lower and upper half of the reference's number, as
// ordinary floats (its bits would make subnormal numbers, which are slow).
struct Item {
  Bounds box;

  [[nodiscard]] std::uint32_t reference() const {
    return static_cast<std::uint32_t>(box.lo[3]) | (static_cast<std::uint32_t>(box.hi[3]) << 16U);
  }
  [[nodiscard]] Float4 twice_centre() const { return box.lo + box.hi; }
};

// An inner node. Its items are a run in BinaryTree::items; the first left_count of them lie under its left child.
struct BinaryNode {
  std::array<float, 3> lo;
  std::uint32_t left_count;
  std::array<float, 3> hi;
  std::uint32_t plan;  // written and read by the collapse
};
static_assert(sizeof(Item) == 32 && sizeof(BinaryNode) == 32);

// Every leaf is one item, so that the collapse decides the leaves. Nodes stand in depth-first order, left before right: a
// subtree of n items whose root is node k owns the nodes k .. k + n - 2, which makes child pointers unnecessary.
struct BinaryTree {
  std::vector<Item> items;
  std::vector<BinaryNode> nodes;  // items.size() - 1 of them; empty for less than two items
};

// A subtree: `count` items from `first` on; `node` is its root if count > 1.
struct Subtree {
  std::uint32_t node = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// Any binary tree of this height fits into max_bvh_depth levels of eight children: a level holds three binary ones.
inline constexpr int max_binary_height = 3 * max_bvh_depth;

// Orders the items and fills the nodes; the tree is at most max_height high, which must do for equal halves throughout.
void build_binary_tree(BinaryTree& tree, int max_height = max_binary_height);

// The compressed tree over the references that the items stand for. Writes the plans into `tree`.
[[nodiscard]] Bvh collapse(BinaryTree& tree, const Canopy& canopy, std::span<const Reference> references);

}  // namespace sunfleck::detail

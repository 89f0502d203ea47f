#pragma once
// Internal to bvh: the binary tree from which the collapse makes the tree with eight children (collapse.h). It takes 40 bytes
// per reference, since nodes have no boxes: those few that the collapse keeps are measured again from the items.

#include <oneapi/tbb/parallel_invoke.h>

#include <cstdint>
#include <vector>

namespace sunfleck::detail {

// Four floats in one register; `a < b ? a : b` selects lane by lane. Lane 3 is carried along.
using Float4 [[gnu::vector_size(16)]] = float;

// Largest coordinate of a tree, m: areas stay far inside the range of single precision.
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

// The initial value of a growing box; its half_area() is finite.
inline constexpr Bounds nothing{Float4{1e15F, 1e15F, 1e15F, 1e15F}, Float4{-1e15F, -1e15F, -1e15F, -1e15F}};

// The padded box of a reference. Lane 3 of lo and hi holds the lower and upper half of the reference's number, as ordinary
// floats (as bits they would make subnormal numbers, which are slow).
struct Item {
  Bounds box;

  [[nodiscard]] std::uint32_t reference() const {
    return static_cast<std::uint32_t>(box.lo[3]) | (static_cast<std::uint32_t>(box.hi[3]) << 16U);
  }
  [[nodiscard]] Float4 twice_centre() const { return box.lo + box.hi; }
};

// An inner node. Its items are a run in BinaryTree::items; the first left_count of them lie under its left child.
struct BinaryNode {
  std::uint32_t left_count;
  std::uint32_t plan;  // written and read by the collapse
};
static_assert(sizeof(Item) == 32 && sizeof(BinaryNode) == 8);

// A binary tree whose leaves hold one item each, so that the collapse decides on the final leaves. Nodes are in depth-first
// order, left before right: a subtree of n items whose root is node k occupies the nodes k .. k + n - 2, so no child
// pointers are needed.
struct BinaryTree {
  std::vector<Item> items;
  std::vector<BinaryNode> nodes;  // items.size() - 1 nodes; empty for fewer than two items
};

// A subtree: `count` items beginning with `first`; `node` is its root if count > 1.
struct Subtree {
  std::uint32_t node = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// Runs what is to be done in both children of a subtree, by two threads if it is large.
template <class Left, class Right>
void in_both_children(const Subtree& subtree, const Left& left, const Right& right) {
  constexpr std::uint32_t large = 4096;
  if (subtree.count >= large) return tbb::parallel_invoke(left, right);
  left();
  right();
}

// Orders the items and fills the nodes. The tree is at most max_height high, which must be enough for splitting into equal
// halves throughout.
void build_binary_tree(BinaryTree& tree, int max_height);

}  // namespace sunfleck::detail

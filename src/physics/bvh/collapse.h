#pragma once
// Internal to bvh: converts the binary tree to eight-wide compressed nodes (Ylitie, Karras & Laine 2017, sections 3 and 4).

#include "physics/bvh/binary_tree.h"
#include "physics/bvh/bvh.h"

#include <cstdint>
#include <functional>

namespace sunfleck::detail {

// What the items of a tree stand for; exactly one of both functions is given.
struct ItemContents {
  std::function<BvhTriangle(std::uint32_t item)> triangle;
  std::function<BvhCopy(std::uint32_t item)> copy;
};

// Returns the compressed tree over the items, at most `max_depth` levels deep, whose binary tree is at most three times as
// high. Writes the plans into `tree`.
[[nodiscard]] Bvh collapse(BinaryTree& tree, const ItemContents& contents, int max_depth);

}  // namespace sunfleck::detail

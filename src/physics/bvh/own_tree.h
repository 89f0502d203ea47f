#pragma once
// Internal to bvh: the tree over triangles.

#include "physics/bvh/binary_tree.h"
#include "physics/bvh/bvh.h"
#include "physics/bvh/collapse.h"
#include "physics/canopy/canopy.h"

#include <cstdint>

namespace sunfleck::detail {

// Returns the item of a box that is enlarged by `padding_m` on every side. Throws EXPECT's error for coordinates of 1e15 m and
// more.
[[nodiscard]] Item padded_item(const Box& box, float padding_m, std::uint32_t number);

// Returns the tree of items, at most `max_depth` levels deep.
[[nodiscard]] Bvh build_tree(BinaryTree& tree, const ItemContents& contents, int max_depth);

// Returns the tree of all references to elements with corners of their own, at most `max_depth` levels deep.
[[nodiscard]] Bvh build_own_tree(const Canopy& canopy, float padding_m, int max_depth);

}  // namespace sunfleck::detail

#pragma once
// Inside bvh only: one compressed node's slots and its grid of boxes.

#include "bvh/binary_tree.h"

namespace sunfleck::detail {

// Which child (-1: none) goes into which slot, by where the child lies in the node: bit 2, 1, 0 of its slot set for the
// lower half of x, y, z as far as the children do not compete. At most eight children.
[[nodiscard]] std::array<int, 8> assign_slots(std::span<const Bounds> children);

// A node with eight empty slots and a grid that covers all the children.
[[nodiscard]] BvhNode empty_node(std::span<const Bounds> children);

// Rounds the box outwards to the node's grid; the box lies in one of those that the grid was made for.
void set_box(BvhNode& node, std::size_t slot, const Bounds& box);

}  // namespace sunfleck::detail

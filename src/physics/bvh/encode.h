#pragma once
// Internal to bvh: the slots of one compressed node and its grid of boxes.

#include "physics/bvh/binary_tree.h"
#include "physics/bvh/bvh.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sunfleck::detail {

// Returns the power of two whose exponent, plus 127, is given: the size of a step of a node's grid.
[[nodiscard]] inline float power_of_two(std::uint32_t biased_exponent) {
  return std::bit_cast<float>(biased_exponent << 23U);
}

// Returns the child of each slot (-1: none), chosen by the position of the child in the node: bit 2, 1, 0 of its slot is set
// for the lower half of x, y, z unless children compete for it. There are at most eight children.
[[nodiscard]] std::array<int, 8> assign_slots(std::span<const Bounds> children);

// Returns a node with eight empty slots and a grid that covers all the children.
[[nodiscard]] BvhNode empty_node(std::span<const Bounds> children);

// Rounds the box outwards to the node's grid; the box must lie in one of those for which the grid was made.
void set_box(BvhNode& node, std::size_t slot, const Bounds& box);

}  // namespace sunfleck::detail

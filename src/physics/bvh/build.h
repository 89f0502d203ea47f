#pragma once
// Builds the tree of a canopy.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"

namespace sunfleck {

// Builds the tree of all references of the canopy: a binary tree by binned surface area heuristic, collapsed to eight
// children by dynamic programming, with at most three triangles per child. Boxes are enlarged by `padding_m` on every side
// before they are rounded outwards to the nodes' grid, so that rounding in the walk never loses a triangle. The same input
// gives the same tree, byte for byte. Coordinates must be below 1e15 m. Throws as make_references does.
[[nodiscard]] Bvh build_bvh(const Canopy& canopy, float padding_m);

}  // namespace sunfleck

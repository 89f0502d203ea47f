#pragma once
// Reads the compressed nodes of a tree back: the boxes of their children, and figures of the whole tree.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"

#include <cstddef>

namespace sunfleck {

struct BvhStatistics {
  // Expected node visits + triangle tests per ray that meets the root box; all nodes and triangles if that box has no
  // area.
  double sah_cost = 0.0;
  std::size_t inner_children = 0;
  std::size_t leaf_children = 0;
};

// Returns the box of a child slot as a walk in single precision decodes it.
[[nodiscard]] Box child_box(const BvhNode& node, int slot);

[[nodiscard]] BvhStatistics statistics(const Bvh& bvh);

}  // namespace sunfleck

#pragma once
// Reads the boxes of the compressed nodes of a tree back.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"

namespace sunfleck {

// Returns the box of a child slot as a walk in single precision decodes it.
[[nodiscard]] Box child_box(const BvhNode& node, int slot);

}  // namespace sunfleck

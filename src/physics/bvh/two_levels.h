#pragma once
// Internal to bvh: the tree of a canopy in which copies share the triangles of their mesh.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"

namespace sunfleck::detail {

// Returns a tree of copies, one for each mesh copy and each period from which it reaches into the plot, above one tree of
// triangles for each mesh. Both levels together fit into max_bvh_depth. Throws Error (input) for more than 2^31 triangles,
// counting all copies, and as make_references does.
[[nodiscard]] Bvh build_two_levels(const Canopy& canopy, float padding_m);

}  // namespace sunfleck::detail

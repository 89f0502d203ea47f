#pragma once
// Internal to bvh: converts the binary tree to eight-wide compressed nodes (Ylitie, Karras & Laine 2017, sections 3 and 4).

#include "physics/bvh/binary_tree.h"
#include "physics/bvh/bvh.h"
#include "physics/bvh/references.h"
#include "physics/canopy/canopy.h"

#include <span>

namespace sunfleck::detail {

// Returns the compressed tree over the references of the items. Writes the plans into `tree`.
[[nodiscard]] Bvh collapse(BinaryTree& tree, const Canopy& canopy, std::span<const Reference> references);

}  // namespace sunfleck::detail

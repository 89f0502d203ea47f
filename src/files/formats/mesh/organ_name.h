#pragma once
// Names of organs in mesh files that hold one node, object or group per organ.

#include "physics/canopy/mesh.h"

#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Parses the name of an organ: `plant1_leaf7` is plant 1, leaf, rank 7; `plant1_leaf2_7` is leaf2, rank 7; `plant1_x_-3` has rank
// -3; `plant2_stem` has rank 0. Ignores a suffix like `.001`, which editors add to make names unique. Returns nothing for any
// other name.
[[nodiscard]] std::optional<Organ> organ_from_name(std::string_view name);

// Returns e.g. plant1_leaf7, which organ_from_name reads back.
[[nodiscard]] std::string node_name(const Organ& organ);

}  // namespace sunfleck

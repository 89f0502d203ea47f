#pragma once
// Warns about valid but unlikely input.

#include "files/scene/scene_reader.h"

#include <string>
#include <vector>

namespace sunfleck {

// Returns warnings about valid but unlikely input: lengths in another unit, plants below ground, plants without leaves, leaves
// without a plant, triangles that coincide, missing light. `all_z_up` says whether every mesh is already read with up = "z".
[[nodiscard]] std::vector<std::string> plausibility_warnings(const Scene& scene, bool all_z_up);

}  // namespace sunfleck

#pragma once
// Warns about valid but unlikely input.

#include "files/scene/scene_reader.h"

#include <string>
#include <vector>

namespace sunfleck {

// Returns warnings about valid but unlikely input: lengths in another unit, plants below ground,
// triangles that coincide, missing light.
[[nodiscard]] std::vector<std::string> plausibility_warnings(const Scene& scene);

}  // namespace sunfleck

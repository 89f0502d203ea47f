#pragma once
// Warns about planes, sensors and a plot that do not fit the stand.

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"

#include <string>
#include <vector>

namespace sunfleck {

// Returns warnings about planes above the stand, sensors below the ground or outside the plot (more than one period outside if the
// plot is periodic) and a plot many times wider than the stand. `root` locates them.
[[nodiscard]] std::vector<std::string> receiver_warnings(const TomlTable& root, const Scene& scene);

}  // namespace sunfleck

#pragma once
// Finds the files that a scene names.

#include "files/scene/scene_reader.h"
#include "files/scene/toml_view.h"

#include <filesystem>
#include <string_view>

namespace sunfleck {

// Returns the location of the file named by that key of the table, with symbolic links resolved: relative to the scene's
// folder, and inside it unless `access` allows more. Refuses anything but a regular file; `wanted` is the advice in the
// message. Adds the unresolved path to access.files, which must be set, because a link may be redirected and a missing file may
// appear.
[[nodiscard]] std::filesystem::path find_scene_file(const TomlTable& table, const std::filesystem::path& scene_file,
                                                    const SceneAccess& access, std::string_view wanted,
                                                    std::string_view key = "file");

}  // namespace sunfleck

#pragma once
// Loads a command's scene from a scene file, or from a mesh with CARIBU's files.

#include "app/options.h"
#include "io/caribu_scene.h"
#include "io/scene_reader.h"

#include <filesystem>
#include <string>

namespace sunfleck {

// Loads the scene from whichever of the two `scene` is. Also throws Error (input) for a mesh without optics or light, for mesh
// options next to a scene file, and for a day with a mesh, which has no place. Scene::files includes CARIBU's files; the digest
// covers them through the values that the scene's text takes from them.
[[nodiscard]] Scene load_scene(const std::filesystem::path& scene, const StandFiles& stand, const SceneAccess& access);

// Returns the set of files that a mesh forms with these options. Throws Error (input) if optics or light are missing.
[[nodiscard]] CaribuSet caribu_set(const std::filesystem::path& mesh, const StandFiles& stand, bool allow_outside);

// Returns the name of `file` for a scene in `folder`: relative if the file is in that folder or below it, after resolving
// links; otherwise the absolute path.
[[nodiscard]] std::filesystem::path name_from(const std::filesystem::path& folder, const std::filesystem::path& file);

// Returns the name for results: the scene's file name without .toml, .can, .can.gz, ...
[[nodiscard]] std::string scene_stem(const std::filesystem::path& scene);

}  // namespace sunfleck

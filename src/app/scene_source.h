#pragma once
// Where a command's scene comes from: a scene file, or a mesh with CARIBU's files beside it.

#include "app/options.h"
#include "io/caribu_scene.h"
#include "io/scene_reader.h"

#include <filesystem>
#include <string>

namespace sunfleck {

// The scene, whichever of the two `scene` is. Throws Error (input) also for a mesh without optics or light, for the options of
// one beside a scene file, and for the day of a mesh, which has no place. Scene::files has CARIBU's files too; the digest
// covers them by the values that the scene's text takes from them.
[[nodiscard]] Scene load_scene(const std::filesystem::path& scene, const StandFiles& stand, const SceneAccess& access);

// The set that a mesh makes with these options. Throws Error (input) where optics or light are missing.
[[nodiscard]] CaribuSet caribu_set(const std::filesystem::path& mesh, const StandFiles& stand, bool allow_outside);

// The name of `file` for a scene in `folder`: relative if it lies there or below, links resolved; else the whole path.
[[nodiscard]] std::filesystem::path name_from(const std::filesystem::path& folder, const std::filesystem::path& file);

// What results are called after: the file's name without .toml, .can, .can.gz, ...
[[nodiscard]] std::string scene_stem(const std::filesystem::path& scene);

}  // namespace sunfleck

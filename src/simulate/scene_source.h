#pragma once
// Reads a command's scene: a scene file, a mesh with CARIBU's files beside it, or a mesh alone.

#include "files/scene/caribu_scene.h"
#include "files/scene/scene_reader.h"
#include "simulate/requests.h"

#include <filesystem>
#include <string>

namespace sunfleck {

// Reads the scene, whichever of these it is; `files`, if given, receives every file that is tried, even if reading fails.
// Throws Error (input) also for a mesh without optics or light unless `request.mesh_alone`, for the options of a mesh beside a
// scene file, and for the day of a mesh, which has no place. Scene::files includes CARIBU's files; the digest covers them by
// the values that the scene's text takes from them.
[[nodiscard]] Scene load_scene(const SceneRequest& request, ScenePurpose purpose = ScenePurpose::moment,
                               SourceFiles* files = nullptr);

// Reads the scene as load_scene does, and prints its warnings.
[[nodiscard]] Scene load_scene_with_warnings(const SceneRequest& request, ScenePurpose purpose = ScenePurpose::moment);

// Removes planes and sensors, which the window does not show. Returns whether there were any.
bool remove_receivers(Scene& scene);

// Returns the set of CARIBU files that a mesh and these options specify. Throws Error (input) where optics or light are
// missing.
[[nodiscard]] CaribuSet caribu_set(const std::filesystem::path& mesh, const StandFiles& stand, bool allow_outside);

// Returns the name of `file` for a scene in `folder`: relative if the file lies there or below, after resolving links;
// otherwise the whole path.
[[nodiscard]] std::filesystem::path name_from(const std::filesystem::path& folder, const std::filesystem::path& file);

// Returns the name after which results are called: the file's own name without .toml, .can, .can.gz, ...
[[nodiscard]] std::string scene_stem(const std::filesystem::path& scene);

}  // namespace sunfleck

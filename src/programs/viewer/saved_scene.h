#pragma once
// Writes the scene that a window shows as a scene file, so that `run` makes the saved result again.

#include "files/scene/scene_reader.h"
#include "programs/viewer/light_request.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sunfleck {

inline constexpr const char* saved_scene_file = "scene.toml";
// Folder beside it with copies of the files that the scene names.
inline constexpr const char* saved_scene_files = "scene_files";

struct SceneToSave {
  const Scene& original;        // as read; its canopy may be empty
  const LightRequest& request;  // as granted
  const Scene& granted;         // whose title and light are the ones to save
  Accuracy accuracy;            // bounds in use
  std::uint64_t seed = 1;
};

// Returns the original's text with its title, light, optics and bounds as they are now; comments are lost. Names of files in the
// scene's folder begin with saved_scene_files; other files have their whole path.
[[nodiscard]] std::string saved_scene_text(const SceneToSave& scene);

// Writes that text and copies the scene's files. Throws Error (failure), and Error (input) where it would replace the scene
// itself.
void save_scene(const SceneToSave& scene, const std::filesystem::path& folder);

}  // namespace sunfleck

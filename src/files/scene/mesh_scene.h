#pragma once
// Writes the text of a scene for meshes about which nothing is known but their files; `new` prints it and `view` shows it.

#include "base/source_files.h"

#include <filesystem>
#include <span>
#include <string>

namespace sunfleck {

struct MeshToShow {
  std::filesystem::path file;
  std::string name;  // by which the text refers to the file, from the text's future folder
};

// Surveys the meshes (mesh_survey.h) and returns a commented scene that runs as it is: the meshes side by side on an isolated
// plot with a margin of a tenth of their width, upright and in metres as guessed, with the reasons; a summer noon near Paris
// with one band, PAR; typical optics for every material by its role, and soil. A mesh that floats above the ground or lies
// mostly below it is moved onto it. Throws Error (input) for what read_mesh refuses, names that TOML cannot hold, and a mesh
// without extent. Adds every file read to `files` if that is given.
[[nodiscard]] std::string mesh_scene_text(std::span<const MeshToShow> meshes, bool allow_outside, SourceFiles* files = nullptr);

}  // namespace sunfleck

#pragma once
// Writes a mesh as glTF.

#include "canopy/mesh.h"

#include <filesystem>

namespace sunfleck {

// GLB (name ends in .glb) or glTF with embedded buffer (.gltf): one node a plant and organ with extras {"plant", "organ",
// "rank"}, one material an optics name. read_mesh gives the same triangles, in single precision, with the same optics and
// organs, organ by organ; organs without triangles are left out. From an empty mesh comes a valid file that read_mesh refuses.
// Throws Error: input for another ending, failure if the file cannot be written.
void write_gltf(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace sunfleck

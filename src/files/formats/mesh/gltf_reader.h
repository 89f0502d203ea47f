#pragma once
// Reads glTF and GLB files.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads a .gltf or .glb file with its buffers. Returns coordinates as in the file, neither turned nor scaled; the mesh may
// be empty. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_gltf(const MeshSource& source);

}  // namespace sunfleck

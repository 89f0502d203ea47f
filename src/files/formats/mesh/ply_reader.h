#pragma once
// Reads PLY files.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads a text or binary .ply file. Returns coordinates as in the file, neither turned nor scaled; the mesh may
// be empty. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_ply(const MeshSource& source);

}  // namespace sunfleck

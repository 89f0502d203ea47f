#pragma once
// Reads Wavefront OBJ files.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads an .obj file; no .mtl is needed. Returns coordinates as in the file, neither turned nor scaled; the mesh may
// be empty. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_obj(const MeshSource& source);

}  // namespace sunfleck

#pragma once
// Reads STL files.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads a text or binary .stl file. Returns coordinates as in the file, neither turned nor scaled; the mesh may
// be empty. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_stl(const MeshSource& source);

}  // namespace sunfleck

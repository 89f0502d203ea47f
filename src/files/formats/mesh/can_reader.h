#pragma once
// Reads CARIBU .can and .can.gz files.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads a .can file, which may be compressed by gzip. Returns coordinates as in the file, neither turned nor scaled; the mesh may
// be empty. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_can(const MeshSource& source);

}  // namespace sunfleck

#pragma once
// Reads COLLADA files (.dae).

#include "files/formats/mesh/file_axis.h"
#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

struct DaeMesh {
  Mesh mesh;
  FileAxis up = FileAxis::y;  // y or z
};

// Reads a .dae file: the triangles, polygons, fans and strips of the geometries that the nodes of its scene place, with the
// transforms of the nodes. Returns metres, by the file's unit. A file whose x axis is up is turned so that y is. Organs are named
// after nodes. Skinned and morphed geometry is left out, with a warning. The mesh may be empty. Throws Error (input), one line,
// if the file is malformed.
[[nodiscard]] DaeMesh read_dae(const MeshSource& source);

}  // namespace sunfleck

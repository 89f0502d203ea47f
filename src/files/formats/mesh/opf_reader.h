#pragma once
// Reads plants in the Open Plant Format of AMAP, ARCHIMED and PlantGeom: organs that place, stretch and taper a few base meshes.

#include "files/formats/mesh/mesh_source.h"
#include "physics/canopy/mesh.h"

namespace sunfleck {

// Reads an .opf file. Returns coordinates as in the file, in centimetres with z up; the mesh may be empty. An organ has the name
// of its class, its id as rank and, as its material, the class too. A base point (x, y, z) becomes mat (x, s y, s z, 1) with
// s = dDwn + (dUp - dDwn) (x - lo) / (hi - lo) over the base mesh's extent lo..hi in x, as in PlantGeom, or s = 1 where the two are
// missing or the base mesh has enableScale="false". Geometries without a shapeIndex, which whole plants and axes have, are no
// organs. Throws Error (input), one line, if the file is malformed.
[[nodiscard]] Mesh read_opf(const MeshSource& source);

}  // namespace sunfleck

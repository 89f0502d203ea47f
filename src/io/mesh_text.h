#pragma once
// The bytes of a mesh in the formats that need no library.

#include "canopy/mesh.h"

#include <string>

namespace sunfleck {

// Arrays must fit together, as in a mesh from read_mesh. See mesh_writer.h. Throws Error (failure) for what a format has no
// numbers for.
[[nodiscard]] std::string obj_text(const Mesh& mesh);
[[nodiscard]] std::string ply_mesh_bytes(const Mesh& mesh);
[[nodiscard]] std::string can_text(const Mesh& mesh);

}  // namespace sunfleck

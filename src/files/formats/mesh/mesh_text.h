#pragma once
// Meshes as text or bytes in the formats that need no library.

#include "physics/canopy/mesh.h"
#include "physics/canopy/plot.h"

#include <string>
#include <vector>

namespace sunfleck {

// Return the content of the file; see mesh_writer.h. The arrays must fit together, as in a mesh from read_mesh. Throw Error
// (failure) for numbers that the format cannot hold.
[[nodiscard]] std::string obj_text(const Mesh& mesh, Axes axes = Axes::south_up_west);
[[nodiscard]] std::string ply_mesh_bytes(const Mesh& mesh, Axes axes = Axes::south_up_west);
[[nodiscard]] std::string can_text(const Mesh& mesh);

// Returns the optics names that a .can file cannot hold: it supports soil, and the leaves and stems of nine species.
[[nodiscard]] std::vector<std::string> optics_lost_in_can(const Mesh& mesh);

// Returns how many organs would share a label with another in a .can file.
[[nodiscard]] std::size_t organs_merged_in_can(const Mesh& mesh);

}  // namespace sunfleck

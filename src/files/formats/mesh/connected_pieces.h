#pragma once
// The connected pieces of a mesh, and the places at which its vertices lie.

#include "physics/canopy/mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// Returns the number of each vertex's place, counted from 0: vertices at exactly the same place share it. [vertex]
[[nodiscard]] std::vector<std::uint32_t> places_of_vertices(const Mesh& mesh);

struct ConnectedPieces {
  std::vector<std::uint32_t> piece_of;  // [triangle]
  std::size_t count = 0;
};

// Divides the mesh into pieces: triangles of one organ and one material that share places, directly or through others. Pieces are
// numbered in the order of their first triangles. `places` is what places_of_vertices returns.
[[nodiscard]] ConnectedPieces connected_pieces(const Mesh& mesh, const std::vector<std::uint32_t>& places);

}  // namespace sunfleck

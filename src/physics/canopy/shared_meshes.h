#pragma once
// Meshes whose copies share one set of triangles.

#include "physics/canopy/element_corners.h"
#include "physics/canopy/mesh.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace sunfleck {

// Returns whether the copies of a mesh share its triangles in a canopy of `elements` elements: as PlacedMesh::shared says or,
// if it says nothing, where this saves much memory. Copies that stand in the very same place never do, because light must tell
// which of them it meets.
[[nodiscard]] bool shares_triangles(const PlacedMesh& part, std::size_t elements);

// Returns the place of a copy whose mesh's origin lies at `shift_m` in the canopy's local frame.
[[nodiscard]] shared::CopyTurn turn_of(const Placement& placement, const glm::dvec3& shift_m);

// Returns the triangles of a mesh relative to `origin_m`, to stand at all these places.
[[nodiscard]] SharedMesh shared_mesh(const Mesh& mesh, const glm::dvec3& origin_m, std::span<const shared::CopyTurn> turns);

}  // namespace sunfleck

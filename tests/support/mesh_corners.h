#pragma once
// The corners of a mesh, for comparing meshes whatever their vertices are numbered.

#include "physics/canopy/mesh.h"

#include <glm/vec3.hpp>
#include <vector>

namespace sunfleck {

using Corners = std::vector<glm::dvec3>;

// Returns the corners of all triangles in their order, three each.
inline Corners corners_of(const Mesh& mesh) {
  Corners corners;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) corners.push_back(mesh.vertices[triangle[i]]);
  return corners;
}

}  // namespace sunfleck

#pragma once
// Where the plants of a stand are.

#include "physics/canopy/mesh.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sunfleck {

// The position of a plant, in the scene's axes and before it is wrapped into the plot. The only plant of a mesh stands where
// the mesh was placed; a plant of a mesh with several plants stands below the centroid of its own surface, at the height at
// which the mesh was placed.
struct PlantSite {
  std::uint32_t plant = 1;
  glm::dvec3 position_m{0.0};

  friend bool operator==(const PlantSite&, const PlantSite&) = default;
};

// Returns the plants of all copies, numbered as by assemble_canopy, ascending.
[[nodiscard]] std::vector<PlantSite> plant_sites(std::span<const PlacedMesh> parts);

}  // namespace sunfleck

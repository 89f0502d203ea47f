#pragma once
// Where the plants of a stand are.

#include "physics/canopy/mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
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

// Numbers the plants of a stand, copy by copy: those of a mesh follow the plants before them, unless the copy has a number of its
// own or the mesh keeps its numbers, so that its plants may be parts of earlier ones.
class PlantNumbers {
 public:
  void begin_copy(const Mesh& mesh, std::size_t copy, const Placement& placement);

  // Returns the number in the stand of a plant of the mesh. Throws Error (input) if it is too large.
  [[nodiscard]] std::uint32_t of(std::uint32_t plant);

 private:
  std::optional<std::uint32_t> given_;
  std::uint32_t offset_ = 0, highest_ = 0;
};

// Returns the plants of all copies, numbered as by assemble_canopy, ascending. A plant of several meshes stands where the first of
// them says.
[[nodiscard]] std::vector<PlantSite> plant_sites(std::span<const PlacedMesh> parts);

}  // namespace sunfleck

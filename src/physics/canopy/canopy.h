#pragma once
// The canopy as it is traced: single-precision triangles ("elements") in a local frame, wrapped into the plot.

#include "base/shared_vector.h"
#include "physics/canopy/copies.h"
#include "physics/canopy/element_corners.h"
#include "physics/canopy/mesh.h"
#include "physics/canopy/plants.h"
#include "physics/canopy/plot.h"
#include "physics/canopy/triangle.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

struct Box {
  glm::vec3 lo{0.0F};
  glm::vec3 hi{0.0F};
};

// The elements, numbered in the order of the files, copy by copy. Local frame = scene frame - origin_m. In a periodic plot
// the corners and the periods are whole multiples of a power of two (about 1e-7 of the period), so that a shift by whole
// periods is exact in single precision and neighbouring triangles stay sealed across the plot's border. Copies of a canopy
// share its large arrays, so that models with other light take little memory.
struct Canopy {
  glm::dvec3 origin_m{0.0};               // scene position of the local frame's origin
  glm::dvec2 period_m{0.0};               // period along X and Z on that grid; 0 for an isolated stand
  ElementCorners corners;                 // [element], m, local frame
  SharedVector<std::uint32_t> organ_of;   // [element]
  SharedVector<std::uint16_t> optics_of;  // [element]
  std::vector<Organ> organs;              // [organ]
  std::vector<std::string> optics_names;  // [optics]
  SharedVector<std::uint64_t> labels;     // [element], as in Mesh
  std::vector<Copy> copies;               // ascending by element; copies neither receive nor emit light
  std::vector<PlantSite> plants;          // ascending by number; plant 0, the soil, is not among them

  [[nodiscard]] std::size_t size() const { return corners.size(); }
};

// Places the meshes in the plot. The plants of each copy are numbered from the highest number so far (plant 0, the soil,
// stays 0), so every copy has its own organs; the first copy keeps the numbers of its file. The copies of a mesh share its
// triangles where PlacedMesh::shared says so or, if it says nothing, where this saves much memory: in canopies of more than a
// million triangles, for meshes of at least 64 triangles that stand at least 8 times.
[[nodiscard]] Canopy assemble_canopy(std::span<const PlacedMesh> parts, const Plot& plot);

// Returns where single precision should count a mesh from, in the mesh's own frame: 0 on each axis on which it does not lie
// several times its own size from zero.
[[nodiscard]] glm::dvec3 mesh_origin_m(const Mesh& mesh);

// Returns the bounds of all elements in the local frame; lo = hi = 0 without elements.
[[nodiscard]] Box bounds(const Canopy& canopy);

}  // namespace sunfleck

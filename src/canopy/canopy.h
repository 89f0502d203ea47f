#pragma once
// The canopy as it is traced: single-precision triangles ("elements") in a local frame, wrapped into the plot.

#include "canopy/copies.h"
#include "canopy/mesh.h"
#include "canopy/plot.h"
#include "canopy/triangle.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

struct Box {
  glm::vec3 lo{0.0F};
  glm::vec3 hi{0.0F};
};

// Element numbers follow the order of the files, copy by copy. Local frame = scene frame - origin_m.
// In a periodic plot the corners and the periods are whole multiples of a power of two (about 1e-7 of the period), so that
// a shift by whole periods is exact in single precision and neighbouring triangles stay sealed across the plot's border.
struct Canopy {
  glm::dvec3 origin_m{0.0};               // scene position of the local frame's zero
  glm::dvec2 period_m{0.0};               // X and Z period on that grid; 0 for an isolated stand
  std::vector<Triangle> corners;          // [element], m, local frame, wrapped so that the centroid lies in the plot
  std::vector<std::uint32_t> organ_of;    // [element]
  std::vector<std::uint16_t> optics_of;   // [element]
  std::vector<Organ> organs;              // [organ]
  std::vector<std::string> optics_names;  // [optics]
  std::vector<std::uint64_t> labels;      // [element], as in Mesh
  std::vector<Copy> copies;               // ascending by element; they take no light and give none off

  [[nodiscard]] std::size_t size() const { return corners.size(); }
};

// Places the meshes in the plot. Copy by copy the plants are numbered on from the highest number so far (plant 0, the soil,
// stays 0), so every copy's organs are its own; the first copy keeps its file's numbers.
[[nodiscard]] Canopy assemble_canopy(std::span<const PlacedMesh> parts, const Plot& plot);

// Bounds of all elements in the local frame; lo = hi = 0 without elements.
[[nodiscard]] Box bounds(const Canopy& canopy);

// An organ called soil, soil2, ... counts as soil; one whose name starts with `leaf` as leaf.
[[nodiscard]] bool is_soil_name(std::string_view name);
[[nodiscard]] bool is_leaf_name(std::string_view name);

// What each element counts as, by its organ's and its optics' name. `foliage` marks the elements that leaf area index and
// sunlit leaf fraction are about: leaves, or every element but soil where the canopy has no organ of that name.
struct ElementRoles {
  std::vector<bool> soil;     // [element]
  std::vector<bool> foliage;  // [element]
};
[[nodiscard]] ElementRoles element_roles(const Canopy& canopy);

}  // namespace sunfleck

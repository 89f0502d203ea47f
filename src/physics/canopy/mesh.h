#pragma once
// Triangles as a file or a generator supplies them: indexed, in double precision, in the scene's axes (X south, Y up, Z
// west, metres), before they are placed in the plot.

#include "physics/canopy/role.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// One organ of one plant, the unit of organs.csv.
struct Organ {
  std::uint32_t plant = 1;   // 0 for soil
  std::string name;          // leaf, stem, ear, soil, leaf2, ...
  int rank = 0;              // leaf number from the ground; 0 if there is none
  std::optional<Role> role;  // if given; otherwise the names of the organ and of its optics suggest it

  friend bool operator==(const Organ&, const Organ&) = default;
};

constexpr std::uint64_t no_label = std::numeric_limits<std::uint64_t>::max();

struct Mesh {
  std::vector<glm::dvec3> vertices;       // [vertex], m
  std::vector<glm::uvec3> triangles;      // [triangle], vertex numbers; the counter-clockwise side is the upper face
  std::vector<std::uint32_t> optics_of;   // [triangle], index into optics_names
  std::vector<std::uint32_t> organ_of;    // [triangle], index into organs
  std::vector<std::string> optics_names;  // [optics], the names of the file's materials
  std::vector<Organ> organs;              // [organ], all different
  // [triangle], as in a .can file: O PPPPP LLL EEE as one number, or no_label; empty without any.
  std::vector<std::uint64_t> labels;
  bool keeps_plants = false;  // whether its plants have their own numbers in the canopy, too, in its first copy
};

// The placement of a copy of a mesh in the scene: scaled, turned clockwise as seen from above, then moved.
struct Placement {
  glm::dvec3 position_m{0.0};
  double heading_rad = 0.0;
  double scale = 1.0;                       // > 0
  std::optional<std::uint32_t> plant = {};  // number of the plant in the canopy, of a mesh with a single plant
};

// Returns where a vertex of the mesh lies in the scene, before it is wrapped into the plot.
[[nodiscard]] glm::dvec3 placed_m(const glm::dvec3& vertex_m, const Placement& placement);

// A mesh and its placements; every placement is a copy with its own plants.
struct PlacedMesh {
  Mesh mesh;
  std::vector<Placement> placements;
  std::optional<Role> role;    // of all its organs, if given
  std::optional<bool> shared;  // whether all copies share the mesh's triangles; without a value, where it pays
};

}  // namespace sunfleck

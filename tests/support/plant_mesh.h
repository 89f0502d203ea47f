#pragma once
// A simple plant as a mesh: leaves that rise, arch and droop around a stem.

#include "physics/canopy/mesh.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace sunfleck {

// Lengths in metres. The plant stands on 0, its stem rises along y, and the stem is a closed tube.
struct PlantShape {
  int leaves = 8;
  double height_m = 0.5;  // of the stem
  double leaf_length_m = 0.3;
  double leaf_width_m = 0.04;
  double rise = 1.0;  // slope of the leaf at the stem
};

inline void add_square(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t organ) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
  mesh.organ_of.insert(mesh.organ_of.end(), 2, organ);
  mesh.optics_of.insert(mesh.optics_of.end(), 2, 0);
}

inline void add_leaf(Mesh& mesh, const PlantShape& shape, int number) {
  constexpr int steps = 6;
  constexpr double golden_angle = 2.399963;
  const double turn = number * golden_angle;
  const double start_m = shape.height_m * (number + 1) / shape.leaves;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double out_m = 0.01 * shape.leaf_length_m + share * shape.leaf_length_m;
    const double up_m = start_m + shape.leaf_length_m * shape.rise * share * (1.0 - share);
    for (const double side : {-0.5, 0.5}) {
      const double across_m = side * shape.leaf_width_m * (1.1 - share);
      mesh.vertices.emplace_back(out_m * std::cos(turn) - across_m * std::sin(turn), up_m,
                                 out_m * std::sin(turn) + across_m * std::cos(turn));
    }
  }
  for (std::uint32_t i = 0; i < steps; ++i)
    add_square(mesh, first + 2 * i, first + 2 * i + 1, first + 2 * i + 3, first + 2 * i + 2, 0);
}

inline void add_stem(Mesh& mesh, const PlantShape& shape) {
  constexpr std::uint32_t sides = 4;
  const double radius_m = 0.02 * shape.height_m;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / sides;
    for (const double y_m : {0.0, shape.height_m})
      mesh.vertices.emplace_back(radius_m * std::cos(turn), y_m, radius_m * std::sin(turn));
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    add_square(mesh, first + 2 * i, first + 2 * i + 1, first + 2 * next + 1, first + 2 * next, 0);
  }
  add_square(mesh, first, first + 2, first + 4, first + 6, 0);
  add_square(mesh, first + 1, first + 7, first + 5, first + 3, 0);
}

// Returns the plant with one organ, `plant`, and one material of that name.
inline Mesh plant_mesh(const PlantShape& shape) {
  Mesh mesh;
  mesh.optics_names = {"plant"};
  mesh.organs = {{1, "plant", 0}};
  for (int i = 0; i < shape.leaves; ++i) add_leaf(mesh, shape, i);
  add_stem(mesh, shape);
  return mesh;
}

// Returns the mesh as text, without materials and names.
inline std::string obj_of(const Mesh& mesh) {
  std::string text;
  for (const glm::dvec3& v : mesh.vertices)
    text += "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
  for (const glm::uvec3& t : mesh.triangles)
    text += "f " + std::to_string(t.x + 1) + " " + std::to_string(t.y + 1) + " " + std::to_string(t.z + 1) + "\n";
  return text;
}

}  // namespace sunfleck

#pragma once
// The two maize stands used by the tests, and sums over their triangles.

#include "base/units.h"
#include "physics/canopy/maize.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace sunfleck {

inline MaizeStand sparse_stand(std::uint64_t seed) {
  return {.seed = seed};
}
inline MaizeStand dense_stand(std::uint64_t seed) {
  return {.per_row = 5, .spacing_in_row_m = 0.3, .seed = seed};
}

inline glm::dvec2 plot_size_m(const MaizeStand& stand) {
  return {stand.per_row * stand.spacing_in_row_m, stand.rows * stand.spacing_between_rows_m};
}

inline double plot_area_m2(const MaizeStand& stand) {
  return plot_size_m(stand).x * plot_size_m(stand).y;
}

// Returns the normal of the upper face; its length is the triangle's area.
inline glm::dvec3 area_vector(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& corner = mesh.triangles[triangle];
  const glm::dvec3& a = mesh.vertices[corner.x];
  return 0.5 * glm::cross(mesh.vertices[corner.y] - a, mesh.vertices[corner.z] - a);
}

inline double total_area(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += glm::length(area_vector(mesh, t));
  return sum;
}

inline bool is_leaf(const Mesh& mesh, std::size_t triangle) {
  return mesh.organs[mesh.organ_of[triangle]].name.starts_with("leaf");
}

inline Mesh leaves_of(const Mesh& mesh) {
  Mesh leaves;
  leaves.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_leaf(mesh, t)) leaves.triangles.push_back(mesh.triangles[t]);
  }
  return leaves;
}

}  // namespace sunfleck

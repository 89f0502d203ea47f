#pragma once
// One stand described in several ways that must not change its light.

#include "support/models.h"

#include <vector>

namespace sunfleck::test {

inline const Plot stand_plot{1.0, 1.5, true};

inline Mesh leafy_stand() {
  return random_leaves(60, 0.02, stand_plot, 1.0, 7);
}

// Replaces a model's canopy by the stand at these places of the model's plot.
inline void place_stand(RadiationModel& model, const std::vector<Placement>& placements) {
  const Mesh mesh = leafy_stand();
  const PlacedMesh placed{mesh, placements};
  model.canopy = assemble_canopy(std::span(&placed, 1), model.plot);
}

// Returns placements that fill a plot of twice the size in both directions.
inline std::vector<Placement> four_copies() {
  const double x_m = stand_plot.size_x_m;
  const double z_m = stand_plot.size_z_m;
  return {{{0, 0, 0}, 0}, {{x_m, 0, 0}, 0}, {{0, 0, z_m}, 0}, {{x_m, 0, z_m}, 0}};
}

// Returns the mesh with every triangle cut in four.
inline Mesh cut_in_four(const Mesh& whole) {
  Mesh cut = whole;
  cut.triangles.clear();
  cut.optics_of.clear();
  cut.organ_of.clear();
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const glm::uvec3& corner = whole.triangles[t];
    const auto first = static_cast<std::uint32_t>(cut.vertices.size());
    for (int k = 0; k < 3; ++k) {
      cut.vertices.push_back(0.5 * (whole.vertices[corner[k]] + whole.vertices[corner[(k + 1) % 3]]));
    }
    for (const glm::uvec3& part : {glm::uvec3(corner.x, first, first + 2), glm::uvec3(first, corner.y, first + 1),
                                   glm::uvec3(first + 2, first + 1, corner.z), glm::uvec3(first, first + 1, first + 2)}) {
      cut.triangles.push_back(part);
      cut.optics_of.push_back(whole.optics_of[t]);
      cut.organ_of.push_back(whole.organ_of[t]);
    }
  }
  return cut;
}

}  // namespace sunfleck::test

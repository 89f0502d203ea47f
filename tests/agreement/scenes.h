#pragma once
// Scenes on which all tracers must agree, both ordinary and difficult.

#include "physics/canopy/maize.h"
#include "support/bvh_check.h"
#include "support/models.h"

#include <glm/geometric.hpp>

namespace sunfleck::test {

using testing_bvh::uniform;

inline RadiationModel without_soil(RadiationModel model) {
  model.soil.reset();
  return model;
}

inline RadiationModel maize_model(const MaizeStand& stand, const SunPosition& sun) {
  const Plot plot{stand.per_row * stand.spacing_in_row_m, stand.rows * stand.spacing_between_rows_m, true};
  return black_model(make_maize(stand), plot, sun);
}

// Returns `count` square leaves of `size_m` at random places of a box over a plot of 1 m2, turned at random; they cross each
// other.
inline Mesh random_leaves(int count, double size_m, unsigned seed) {
  testing_bvh::Random random(seed);
  MeshMaker maker;
  for (int leaf = 0; leaf < count; ++leaf) {
    const glm::dvec3 middle = {uniform(random), uniform(random, 0.1, 1.0), uniform(random)};
    const glm::dvec3 normal = glm::normalize(glm::dvec3(testing_bvh::point(random, 1.0)) + glm::dvec3(0.0, 1e-3, 0.0));
    const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(testing_bvh::point(random, 1.0)))) * (0.5 * size_m);
    const glm::dvec3 across = glm::cross(normal, along);
    maker.quad(middle - along - across, middle + along - across, middle + along + across, middle - along + across);
  }
  return maker.mesh();
}

// Returns a level plate over the whole plot of 1 m2, cut into cells x cells squares, with every other square 0.25 m higher.
inline Mesh gridded_plate(int cells) {
  MeshMaker maker;
  for (int x = 0; x < cells; ++x) {
    for (int z = 0; z < cells; ++z) {
      const double y = (x + z) % 2 == 0 ? 0.5 : 0.75;
      maker.level(static_cast<double>(x) / cells, (x + 1.0) / cells, static_cast<double>(z) / cells, (z + 1.0) / cells, y);
    }
  }
  return maker.mesh();
}

// Returns level leaves that lie in one plane, overlap, and occur several times.
inline Mesh coplanar_leaves() {
  MeshMaker maker;
  for (int copy = 0; copy < 5; ++copy) {
    maker.level(0.1, 0.6, 0.1, 0.6, 0.5);
    maker.level(0.4, 0.9, 0.3, 0.8, 0.5);
    maker.triangle({0.2, 0.5, 0.2}, {0.9, 0.5, 0.2}, {0.2, 0.5, 0.9});
    maker.triangle({0.2, 0.5, 0.2}, {0.2, 0.5, 0.9}, {0.9, 0.5, 0.2});
    maker.triangle({0.3, 0.0, 0.3}, {0.7, 0.0, 0.3}, {0.3, 0.0, 0.7});
  }
  return maker.mesh();
}

// Adds the same level triangle `copies` times: more steps for one ray than a dispatch on lavapipe allows.
inline void add_pile(MeshMaker& maker, int copies, double size_m, double y) {
  for (int copy = 0; copy < copies; ++copy) maker.triangle({0.0, y, 0.0}, {0.0, y, size_m}, {size_m, y, 0.0});
}

// Adds slivers at random places of a plot of `size_m`, close to one height: a vertical ray meets the boxes of many and almost
// no triangle, and its neighbours meet others.
inline void add_slivers(MeshMaker& maker, int count, double size_m, double y, double width_m, unsigned seed) {
  testing_bvh::Random random(seed);
  for (int sliver = 0; sliver < count; ++sliver) {
    const glm::dvec3 from = {uniform(random, 0.0, size_m), y + uniform(random, 0.0, 0.01), uniform(random, 0.0, size_m)};
    const glm::dvec3 to = {uniform(random, 0.0, size_m), y + uniform(random, 0.0, 0.01), uniform(random, 0.0, size_m)};
    maker.triangle(from, to, to + glm::dvec3(width_m, 0.0, 0.0));
  }
}

}  // namespace sunfleck::test

#pragma once
// Stands in which plants are copies of few meshes, with or without a tree that the copies share.

#include "physics/canopy/canopy.h"
#include "support/models.h"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace sunfleck::test {

// Returns square leaves that cross each other in a box of 0.6 x 0.5 x 0.6 m around the vertical through zero, an organ each.
inline Mesh leafy_plant(int leaves, std::uint32_t seed) {
  Random random(seed);
  MeshMaker maker;
  for (int leaf = 1; leaf <= leaves; ++leaf) {
    maker.organ("leaf", 1, leaf);
    const glm::dvec3 middle(random.uniform(-0.3, 0.3), random.uniform(0.02, 0.5), random.uniform(-0.3, 0.3));
    const glm::dvec3 normal = inclined(std::acos(random.uniform(-1.0, 1.0)), random.uniform(0.0, 2.0 * std::numbers::pi));
    maker.polygon(middle, normal, random.uniform(0.002, 0.02), 4, random.uniform(0.0, 1.5));
  }
  return maker.mesh();
}

struct CopiesStand {
  Plot plot = unit_plot;
  int plants = 12;
  bool of_all_sizes = true;  // scaled, and at different heights
  std::uint32_t seed = 1;
  int leaves = 30;  // of a plant; from 256 on, the tree of copies holds plants in pieces
};

inline std::vector<Placement> random_placements(const CopiesStand& stand, int count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Placement> placements;
  for (int k = 0; k < count; ++k) {
    Placement placement;
    placement.position_m = {random.uniform(-0.5, 1.5) * stand.plot.size_x_m,
                            stand.of_all_sizes ? random.uniform(0.0, 0.3) : 0.0,
                            random.uniform(-0.5, 1.5) * stand.plot.size_z_m};
    placement.heading_rad = k == 0 ? 0.0 : random.uniform(0.0, 2.0 * std::numbers::pi);
    if (stand.of_all_sizes) placement.scale = random.uniform(0.5, 1.6);
    placements.push_back(placement);
  }
  return placements;
}

// Returns leaves in PAR and NIR over reflecting soil: copies of two plants, and a mesh that stands alone between them.
inline RadiationModel stand_of_copies(const CopiesStand& stand, std::optional<bool> shared) {
  MeshMaker lone;
  lone.organ("leaf");
  lone.level(0.1, 0.4, 0.2, 0.5, 0.25);
  lone.triangle({-0.6, 0.1, 0.3}, {1.7, 0.4, 0.2}, {0.4, 0.6, 1.4});
  const std::vector<PlacedMesh> parts = {
      {leafy_plant(stand.leaves, stand.seed), random_placements(stand, stand.plants / 2, stand.seed + 100), {}, shared},
      {lone.mesh(), {Placement{}}, {}, false},
      {leafy_plant(stand.leaves + 15, stand.seed + 1),
       random_placements(stand, stand.plants - stand.plants / 2, stand.seed + 200),
       {},
       shared}};
  RadiationModel model = black_model({}, stand.plot, beijing_sun());
  model.canopy = assemble_canopy(parts, stand.plot);
  for (const std::string& name : model.canopy.optics_names) model.optics.push_back({name, {}, {}, {}, {}});
  set_leaf_bands(model, std::array{par_band, nir_band});
  return model;
}

}  // namespace sunfleck::test

#include "physics/canopy/plants.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

namespace sunfleck {

namespace {

struct Moments {
  double area_m2 = 0.0;
  glm::dvec3 first_m3{0.0};  // area times position
};

// Returns the position of each plant of a mesh in the mesh's own frame, by its number.
std::map<std::uint32_t, glm::dvec3> feet_m(const Mesh& mesh) {
  std::map<std::uint32_t, glm::dvec3> feet;
  for (const Organ& organ : mesh.organs) {
    if (organ.plant > 0) feet.try_emplace(organ.plant, 0.0);
  }
  if (feet.size() < 2) return feet;
  std::map<std::uint32_t, Moments> moments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& numbers = mesh.triangles[t];
    const std::array<glm::dvec3, 3> corners_m = {mesh.vertices[numbers.x], mesh.vertices[numbers.y], mesh.vertices[numbers.z]};
    const double area_m2 = 0.5 * glm::length(glm::cross(corners_m[1] - corners_m[0], corners_m[2] - corners_m[0]));
    Moments& plant = moments[mesh.organs[mesh.organ_of[t]].plant];
    plant.area_m2 += area_m2;
    plant.first_m3 += area_m2 / 3.0 * (corners_m[0] + corners_m[1] + corners_m[2]);
  }
  for (auto& [number, foot_m] : feet) {
    const Moments& plant = moments[number];
    if (plant.area_m2 > 0.0) foot_m = glm::dvec3(plant.first_m3.x, 0.0, plant.first_m3.z) / plant.area_m2;
  }
  return feet;
}

}  // namespace

void PlantNumbers::begin_copy(const Mesh& mesh, std::size_t copy, const Placement& placement) {
  given_ = placement.plant;
  offset_ = mesh.keeps_plants && copy == 0 ? 0 : highest_;
}

std::uint32_t PlantNumbers::of(std::uint32_t plant) {
  if (plant > std::numeric_limits<std::uint32_t>::max() - offset_) {
    throw_input(fmt::format("plant {} of a mesh", plant), fmt::format("{} plants come before it, too many", offset_),
                "number a mesh's plants from 1");
  }
  const std::uint32_t number = given_.value_or(offset_ + plant);
  highest_ = std::max(highest_, number);
  return number;
}

std::vector<PlantSite> plant_sites(std::span<const PlacedMesh> parts) {
  std::map<std::uint32_t, glm::dvec3> positions_m;
  PlantNumbers numbers;
  for (const PlacedMesh& part : parts) {
    const std::map<std::uint32_t, glm::dvec3> feet = feet_m(part.mesh);
    for (std::size_t copy = 0; copy < part.placements.size(); ++copy) {
      const Placement& placement = part.placements[copy];
      numbers.begin_copy(part.mesh, copy, placement);
      for (const auto& [plant, foot_m] : feet) positions_m.try_emplace(numbers.of(plant), placed_m(foot_m, placement));
    }
  }
  std::vector<PlantSite> sites;
  for (const auto& [plant, position_m] : positions_m) sites.push_back({plant, position_m});
  return sites;
}

}  // namespace sunfleck

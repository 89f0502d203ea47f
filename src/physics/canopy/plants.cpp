#include "physics/canopy/plants.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
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

std::vector<PlantSite> plant_sites(std::span<const PlacedMesh> parts) {
  std::vector<PlantSite> sites;
  std::uint32_t highest = 0;
  for (const PlacedMesh& part : parts) {
    const std::map<std::uint32_t, glm::dvec3> feet = feet_m(part.mesh);
    for (const Placement& placement : part.placements) {
      const std::uint32_t offset = highest;
      for (const auto& [number, foot_m] : feet) {
        sites.push_back({placement.plant.value_or(offset + number), placed_m(foot_m, placement)});
        highest = std::max(highest, sites.back().plant);
      }
    }
  }
  std::sort(sites.begin(), sites.end(), [](const PlantSite& a, const PlantSite& b) { return a.plant < b.plant; });
  return sites;
}

}  // namespace sunfleck

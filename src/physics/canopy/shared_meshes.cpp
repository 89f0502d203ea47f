#include "physics/canopy/shared_meshes.h"

#include "physics/canopy/copies.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace sunfleck {
namespace {

// Measured on stands of 300 to 9,000 triangles a plant: rays that enter and leave many copies take longer, so that a canopy
// which fits any computer keeps triangles of its own.
constexpr std::size_t large_canopy = std::size_t{1} << 20U;
constexpr std::size_t least_triangles = 64;
constexpr std::size_t least_copies = 8;

bool any_stand_together(std::span<const Placement> placements) {
  const auto place = [](const Placement& p) {
    return std::make_tuple(p.position_m.x, p.position_m.y, p.position_m.z, p.heading_rad, p.scale);
  };
  std::vector<decltype(place(Placement{}))> places;
  for (const Placement& placement : placements) places.push_back(place(placement));
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

}  // namespace

bool shares_triangles(const PlacedMesh& part, std::size_t elements) {
  const std::size_t triangles = part.mesh.triangles.size();
  const bool pays = elements > large_canopy && triangles >= least_triangles && part.placements.size() >= least_copies;
  return part.shared.value_or(pays) && triangles > 0 && !any_stand_together(part.placements);
}

shared::CopyTurn turn_of(const Placement& placement, const glm::dvec3& shift_m) {
  const double c = std::cos(placement.heading_rad);
  const double s = std::sin(placement.heading_rad);
  const double scale = placement.scale;
  return {.shift = glm::vec3(shift_m),
          .cos_out = static_cast<float>(c * scale),
          .sin_out = static_cast<float>(s * scale),
          .scale = static_cast<float>(scale),
          .cos_back = static_cast<float>(c / scale),
          .sin_back = static_cast<float>(s / scale),
          .per_scale = static_cast<float>(1.0 / scale)};
}

SharedMesh shared_mesh(const Mesh& mesh, const glm::dvec3& origin_m, std::span<const shared::CopyTurn> turns) {
  SharedMesh result;
  for (const glm::uvec3& numbers : mesh.triangles) {
    Triangle corners;
    for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = mesh.vertices[numbers[k]] - origin_m;
    result.corners.push_back(corners);
    const bool has_area = std::all_of(turns.begin(), turns.end(), [&](const shared::CopyTurn& turn) {
      return area_m2({shared::placed_point(turn, corners[0]), shared::placed_point(turn, corners[1]),
                      shared::placed_point(turn, corners[2])}) > 0.0;
    });
    result.traced.push_back(has_area);
  }
  for (const Copy& copy : find_copies(result.corners)) result.traced[copy.element] = false;
  return result;
}

}  // namespace sunfleck

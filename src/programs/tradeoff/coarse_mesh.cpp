#include "programs/tradeoff/coarse_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sunfleck {
namespace {

// Any deformation is accepted if the share requires it; relative to the surface's extent.
constexpr float most_deformation = 1.0F;

// A surface whose coincident corners are merged, so that neighbouring triangles are recognised as neighbours.
struct IndexedSurface {
  std::vector<glm::vec3> vertices;
  std::vector<unsigned> indices;
};

IndexedSurface welded(const Canopy& canopy, const std::vector<std::size_t>& elements) {
  std::vector<glm::vec3> corners;
  for (const std::size_t e : elements) {
    const Triangle triangle = canopy.corners[e];
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  std::vector<unsigned> remap(corners.size());
  const std::size_t vertices =
      meshopt_generateVertexRemap(remap.data(), nullptr, corners.size(), corners.data(), corners.size(), sizeof(glm::vec3));
  IndexedSurface surface{std::vector<glm::vec3>(vertices), std::vector<unsigned>(corners.size())};
  meshopt_remapVertexBuffer(surface.vertices.data(), corners.data(), corners.size(), sizeof(glm::vec3), remap.data());
  meshopt_remapIndexBuffer(surface.indices.data(), static_cast<const unsigned*>(nullptr), corners.size(), remap.data());
  return surface;
}

std::vector<unsigned> simplified(const IndexedSurface& surface, double share) {
  const std::size_t triangles = surface.indices.size() / 3;
  const std::size_t wanted = 3 * static_cast<std::size_t>(std::max(1.0, std::round(share * static_cast<double>(triangles))));
  std::vector<unsigned> indices(surface.indices.size());
  const std::size_t count =
      meshopt_simplify(indices.data(), surface.indices.data(), surface.indices.size(), &surface.vertices[0].x,
                       surface.vertices.size(), sizeof(glm::vec3), wanted, most_deformation, 0, nullptr);
  if (count == 0) return surface.indices;
  indices.resize(count);
  return indices;
}

}  // namespace

Canopy coarsened(const Canopy& canopy, double share) {
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::vector<std::size_t>> surfaces;
  for (std::size_t e = 0; e < canopy.size(); ++e) surfaces[{canopy.organ_of[e], canopy.optics_of[e]}].push_back(e);
  Canopy coarse;
  coarse.origin_m = canopy.origin_m;
  coarse.period_m = canopy.period_m;
  coarse.organs = canopy.organs;
  coarse.optics_names = canopy.optics_names;
  for (const auto& [kind, elements] : surfaces) {
    const IndexedSurface surface = welded(canopy, elements);
    const std::vector<unsigned> indices = simplified(surface, share);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      coarse.corners.push_back(
          {surface.vertices[indices[i]], surface.vertices[indices[i + 1]], surface.vertices[indices[i + 2]]});
      coarse.organ_of.push_back(kind.first);
      coarse.optics_of.push_back(kind.second);
    }
  }
  return coarse;
}

}  // namespace sunfleck

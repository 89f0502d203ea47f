#pragma once
// Walks the tree for a bundle of parallel rays. Their node visits are shared: a box is tested once for all of them, by the
// range of their origins, and a triangle of a leaf for eight rays at once.

#include "devices/tracers/cpu_walk.h"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace sunfleck {

inline constexpr std::uint32_t rays_per_bundle = 16;

// Rays of one direction in one period.
struct RayBundle {
  shared::Ray along;  // a ray of that direction; its origin has no meaning
  std::uint32_t rays = 0;
  std::array<glm::vec3, rays_per_bundle> origins;
  std::array<float, rays_per_bundle> limits;
  std::array<OwnElement, rays_per_bundle> own;  // what each ray ignores; beam rays nothing
};

using BundleHits = std::array<CpuHit, rays_per_bundle>;

// Returns the square of the distance between two parallel rays, of which one starts at `apart` from the other.
[[nodiscard]] inline float distance_squared(const glm::vec3& apart, const glm::vec3& direction) {
  const glm::vec3 across = glm::cross(apart, direction);
  return glm::dot(across, across);
}

// Finds for each ray what nearest_hit finds. Rays that start far from each other are found too, but slowly.
void nearest_hits(const Bvh& bvh, const RayBundle& bundle, BundleHits& hits);

}  // namespace sunfleck

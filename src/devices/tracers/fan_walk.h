#pragma once
// Walks the tree for a fan: rays that start near each other and travel in similar directions, such as those of neighbouring
// places in a picture. Their node visits are shared, as in bundle_walk.h; a box is tested once for the range of their origins
// and directions.

#include "devices/tracers/bundle_walk.h"

#include <array>
#include <cstdint>

namespace sunfleck {

struct RayFan {
  std::uint32_t rays = 0;
  std::array<shared::Ray, rays_per_bundle> along;
  std::array<float, rays_per_bundle> limits;
};

// Finds for each ray what nearest_hit finds. Rays that have little in common are found too, but slowly.
void nearest_hits(const Bvh& bvh, const RayFan& fan, Images images, BundleHits& hits);

}  // namespace sunfleck

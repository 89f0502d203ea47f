#pragma once
// The walk over the tree on the CPU: nearest hit of one ray in one period, bit for bit what shaders/traverse.glsl finds.

#include "bvh/bvh.h"
#include "shared/intersect.h"
#include "shared/layout.h"

#include <cstdint>

namespace sunfleck {

// Nearest hit of one ray among the references of one period; `triangle` is its place in leaf order.
struct CpuHit {
  bool found = false;
  float t = 0.0F;
  float weight_b = 0.0F;
  float weight_c = 0.0F;
  std::uint32_t lower = 0;
  std::uint32_t element = 0;
  std::uint32_t triangle = 0;
};

// Elements where the canopy has them only, or their copies that reach into the period as well.
enum class Images { all, originals };

// An element's copy that a ray does not meet: the one it starts from.
struct OwnElement {
  std::uint32_t element = shared::no_element;
  std::uint32_t image = 0;
};

// Nearest hit with 0 < t <= limit; at equal distance the first as shared::hit_precedes says.
[[nodiscard]] CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images = Images::all,
                                 OwnElement own = {});
[[nodiscard]] CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own = {});

}  // namespace sunfleck

#pragma once
// Walks the tree on the CPU: finds the nearest hit of one ray in one period, bit for bit the hit that shaders/traverse.glsl
// finds.

#include "physics/bvh/bvh.h"
#include "shared/intersect.h"
#include "shared/layout.h"
#include "shared/turn.h"

#include <cstdint>

namespace sunfleck {

// The nearest hit of one ray among the references of one period.
struct CpuHit {
  bool found = false;
  float t = 0.0F;
  float weight_b = 0.0F;
  float weight_c = 0.0F;
  std::uint32_t lower = 0;
  std::uint32_t element = 0;
  std::uint32_t triangle = 0;   // place in leaf order, counting the triangles of each copy
  std::uint32_t reference = 0;  // index into Bvh::triangles
  std::uint32_t copy = 0;       // the node of the copy, in a tree with copies
};

// Returns where a ray with that hit lands.
[[nodiscard]] inline shared::Landing landing_of(const CpuHit& hit) {
  return {2 * hit.element + hit.lower, hit.triangle, hit.weight_b, hit.weight_c};
}

// Selects elements at their own place only, or also their copies that extend into the period.
enum class Images { all, originals };

// The copy of an element that a ray ignores, because the ray starts on it.
struct OwnElement {
  std::uint32_t element = shared::no_element;
  std::uint32_t image = 0;
};

// What to search: the nearest hit with 0 < t <= limit.
struct Search {
  shared::Ray ray;
  float limit = 0.0F;
  OwnElement own;
};

// Returns where a copy of the tree stands.
[[nodiscard]] shared::CopyTurn turn_of(const BvhCopy& copy);

// Return the nearest hit with 0 < t <= limit; at equal distance the first in the order of shared::hit_precedes.
[[nodiscard]] CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images = Images::all,
                                 OwnElement own = {});
[[nodiscard]] CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own = {});

}  // namespace sunfleck

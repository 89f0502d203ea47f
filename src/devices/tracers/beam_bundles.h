#pragma once
// Follows beam rays to their ends in bundles that share their visits to the tree.
//
// All rays of a beam have one direction, and rays with nearby numbers start near each other: sixteen of them fill a square of 4
// x 4 cells of the grid. In an endless canopy a batch of rays is followed period by period. Rays that end in a period are
// counted; the others keep their order, so those that cross the same border are neighbours again in the next period, in new,
// full bundles. Where the next ray in the order is too far from the first of a bundle, a new bundle begins.

#include "devices/tracers/landing_counter.h"

#include <cstdint>

namespace sunfleck {

// A batch of about this many rays has enough neighbours left after a few periods.
inline constexpr std::uint32_t rays_per_batch = 1024;

// Returns whether rays of the beam lie close enough to each other, beside triangles of that typical size (triangle_size_squared),
// for bundles to take less time than rays side by side (side_by_side.h).
[[nodiscard]] bool pays_in_bundles(const shared::BeamBlock& beam, float size_squared);

// Follows rays first..end-1 of the beam and counts their landings, those that CpuTracer::finish_ray counts one by one.
void count_in_bundles(const Bvh& bvh, TraceDomain domain, const shared::BeamBlock& beam, std::uint32_t first, std::uint32_t end,
                      const LandingCounter& landings);

}  // namespace sunfleck

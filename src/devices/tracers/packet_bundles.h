#pragma once
// Follows packets of one direction, such as rays towards the sun, in bundles that share their visits to the tree.

#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "shared/layout.h"

#include <span>

namespace sunfleck {

// Returns the square of the size of a typical triangle: twice the median area, m2.
[[nodiscard]] float triangle_size_squared(const Bvh& bvh);

[[nodiscard]] bool have_one_direction(std::span<const shared::Packet> packets);

// Follows packets of one direction to their ends: those that follow each other share a bundle if they start near each other. The
// landings are those of single packets. Returns false, having done nothing, if their directions differ, or if they start so far
// from each other, compared with the size of a typical triangle, that they would share little of their way through the tree.
[[nodiscard]] bool trace_in_bundles(const Bvh& bvh, const shared::PacketBlock& scene, TraceDomain domain, float size_squared,
                                    std::span<const shared::Packet> packets, std::span<shared::Landing> landings);

}  // namespace sunfleck

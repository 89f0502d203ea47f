#pragma once
// The copies of elements that a tree covers, and the positions of their corners.

#include "physics/canopy/canopy.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sunfleck {

// One appearance of an element in the period that the tree covers.
struct Reference {
  std::uint32_t element = 0;
  std::int16_t dx = 0;
  std::int16_t dz = 0;
};

// Returns the references to all elements. In a periodic plot an element whose box reaches beyond the border is referenced
// again wherever a copy of it, shifted by whole periods, reaches into the plot enlarged by border_margin_m on every side.
// The order is by element, with image (0, 0) first if it reaches into the plot. A centroid in the plot does not by itself
// make image (0, 0) a reference of the period, but the element's own box always overlaps the plot, so it is one. Elements
// whose area_m2 is 0 and copies of earlier elements have no reference, so nothing can hit them. Throws Error (input) for
// more than 2^31 references, or for a copy 2^15 periods away.
[[nodiscard]] std::vector<Reference> make_references(const Canopy& canopy);

// Returns the corners of a reference: the element's corners + (dx * period x, 0, dz * period z), summed in double, rounded
// once.
[[nodiscard]] Triangle reference_corners(const Canopy& canopy, const Reference& reference);

// Returns how far the references of a period reach beyond the plot's border, per axis (x, z): 2^-18 of the period.
[[nodiscard]] glm::vec2 border_margin_m(const Canopy& canopy);

}  // namespace sunfleck

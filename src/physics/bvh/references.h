#pragma once
// The copies of elements that a tree covers, and the positions of their corners.

#include "physics/bvh/bvh.h"
#include "physics/canopy/canopy.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sunfleck {

// Most triangles that a tree may hold, counting copies in all periods.
inline constexpr std::uint64_t max_references = std::uint64_t{1} << 31U;

// One appearance of an element in the period that the tree covers.
struct Reference {
  std::uint32_t element = 0;
  std::int16_t dx = 0;
  std::int16_t dz = 0;
};

// The periods first..last along an axis.
struct ImageRange {
  int first = 0, last = 0;

  [[nodiscard]] std::uint64_t count() const { return static_cast<std::uint64_t>(std::int64_t{last} - first + 1); }
  [[nodiscard]] bool holds_origin() const { return first <= 0 && last >= 0; }
};

// The copies of something that reach into the plot.
struct ImageRanges {
  ImageRange x, z;

  [[nodiscard]] std::uint64_t count() const { return x.count() * z.count(); }
  [[nodiscard]] bool holds_origin() const { return x.holds_origin() && z.holds_origin(); }
};

// Returns the copies of a box that reach into the plot enlarged by border_margin_m; the first copy alone in an isolated stand.
// Throws Error (input) for a copy 2^15 periods away, naming `element` as what is too large.
[[nodiscard]] ImageRanges images_of(const Canopy& canopy, const Box& box, std::size_t element);

// Returns the references to all elements with corners of their own. In a periodic plot an element whose box reaches beyond the
// border is referenced again wherever a copy of it, shifted by whole periods, reaches into the plot enlarged by border_margin_m
// on every side. The order is by element, with image (0, 0) first if it reaches into the plot. That of a wrapped element always
// does, since its centroid lies in the plot. Elements whose area_m2 is 0 and copies of earlier elements have no reference, so
// nothing can hit them. Throws Error (input) for more than 2^31 references, or for a copy 2^15 periods away.
[[nodiscard]] std::vector<Reference> make_references(const Canopy& canopy);

// Returns the corners of a reference: the element's corners + (dx * period x, 0, dz * period z), summed in double, rounded
// once.
[[nodiscard]] Triangle reference_corners(const Canopy& canopy, const Reference& reference);

// Returns the box around a triangle.
[[nodiscard]] Box box_of(const Triangle& corners);

// Return a triangle as trees hold it, without a counter.
[[nodiscard]] BvhTriangle bvh_triangle(const Triangle& corners, std::uint32_t element, std::uint32_t image);
[[nodiscard]] BvhTriangle reference_triangle(const Canopy& canopy, const Reference& reference);

// Returns how far the references of a period reach beyond the plot's border, per axis (x, z): 2^-18 of the period.
[[nodiscard]] glm::vec2 border_margin_m(const Canopy& canopy);

}  // namespace sunfleck

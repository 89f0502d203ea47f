#pragma once
// The tree: an 8-wide bounding volume hierarchy with compressed nodes (Ylitie, Karras & Laine 2017, "Efficient incoherent
// ray traversal on GPUs through compressed wide BVHs"), as two flat arrays that the CPU walk and the shaders read alike.

#include "canopy/canopy.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// A node of 80 bytes, read by the shaders as five texels of four 32-bit words.
// The box of child slot k on axis x is origin.x + lo_x[k] * 2^(exponent[0] - 127) .. origin.x + hi_x[k] * 2^(exponent[0] -
// 127). The product is exact; the sum, exact or rounded to single precision, encloses the child's padded triangles either
// way.
// Order: bit 2, 1, 0 of k is set for children towards the low end of x, y, z (unless children compete for a slot). If bit 2,
// 1, 0 of octant is set where the ray's x, y, z direction is negative, descending (k XOR octant) is roughly front to back. A
// walk that stores the hit on slot k in bit (k XOR octant) of a mask therefore takes the highest bit b first and recovers
// k = b XOR octant.
// meta[k]: 0 for an empty slot (its box is then lo = 255, hi = 0: inverted on every axis, also when decoded);
//   inner child: 0b001'00000 + 24 + k; its node number is child_base + (number of inner slots below k);
//   leaf child: (unary triangle count 0b001, 0b011, 0b111) << 5 | first triangle relative to triangle_base (0..23).
struct BvhNode {
  std::array<float, 3> origin;
  std::array<std::uint8_t, 3> exponent;
  std::uint8_t inner_mask;  // bit k: slot k is an inner child
  std::uint32_t child_base;
  std::uint32_t triangle_base;
  std::array<std::uint8_t, 8> meta;
  std::array<std::uint8_t, 8> lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;
};
static_assert(sizeof(BvhNode) == 80);

// A triangle of 48 bytes, three texels. Corners in the local frame of the canopy, shifted by the periods of `image`.
struct BvhTriangle {
  std::array<float, 3> a;
  std::uint32_t element;
  std::array<float, 3> b;
  std::uint32_t image;  // pack_image(dx, dz): the copy of the element to which this reference points
  std::array<float, 3> c;
  std::uint32_t counter;  // set to 0 by the builder and filled in by the code that counts landings
};
static_assert(sizeof(BvhTriangle) == 48);

// Packs two signed period numbers into one word; image (0, 0) is the element at its place in the canopy.
[[nodiscard]] constexpr std::uint32_t pack_image(int dx, int dz) {
  return (static_cast<std::uint32_t>(dx) & 0xffffU) | (static_cast<std::uint32_t>(dz) << 16U);
}

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

struct Bvh {
  std::vector<BvhNode> nodes;          // nodes[0] is the root; empty for a canopy without elements
  std::vector<BvhTriangle> triangles;  // in leaf order; all references, each once
  int depth = 0;                       // levels of nodes; at most max_bvh_depth
};

inline constexpr int max_bvh_depth = 30;  // the walks keep one stack entry per level

struct BvhStatistics {
  // Expected node visits + triangle tests per ray that meets the root box; all nodes and triangles if that box has no
  // area.
  double sah_cost = 0.0;
  std::size_t inner_children = 0;
  std::size_t leaf_children = 0;
};

// Builds the tree of all references of the canopy: a binary tree by binned surface area heuristic, collapsed to eight
// children by dynamic programming, with at most three triangles per child. Boxes are enlarged by `padding_m` on every side
// before they are rounded outwards to the nodes' grid, so that rounding in the walk never loses a triangle. The same input
// gives the same tree, byte for byte. Coordinates must be below 1e15 m. Throws as make_references does.
[[nodiscard]] Bvh build_bvh(const Canopy& canopy, float padding_m);

// Returns the box of a child slot as a walk in single precision decodes it.
[[nodiscard]] Box child_box(const BvhNode& node, int slot);

[[nodiscard]] BvhStatistics statistics(const Bvh& bvh);

}  // namespace sunfleck

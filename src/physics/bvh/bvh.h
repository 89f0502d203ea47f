#pragma once
// The tree: an 8-wide bounding volume hierarchy with compressed nodes (Ylitie, Karras & Laine 2017, "Efficient incoherent
// ray traversal on GPUs through compressed wide BVHs"), as two flat arrays that the CPU walk and the shaders read alike.

#include <array>
#include <cstdint>
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

struct Bvh {
  std::vector<BvhNode> nodes;          // nodes[0] is the root; empty for a canopy without elements
  std::vector<BvhTriangle> triangles;  // in leaf order; all references, each once
  int depth = 0;                       // levels of nodes; at most max_bvh_depth
};

inline constexpr int max_bvh_depth = 30;  // the walks keep one stack entry per level

}  // namespace sunfleck

#pragma once
// The tree: an 8-wide bounding volume hierarchy with compressed nodes (Ylitie, Karras & Laine 2017, "Efficient incoherent
// ray traversal on GPUs through compressed wide BVHs"), as two flat arrays that the CPU walk and the shaders read alike.

#include <array>
#include <bit>
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

// A triangle of 48 bytes, three texels. Corners in the local frame of the canopy, shifted by the periods of `image`; those of
// a shared mesh in the frame of that mesh.
struct BvhTriangle {
  std::array<float, 3> a;
  std::uint32_t element;  // in a tree with copies: less the first element of the copy
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

// A copy of a mesh, or of a piece of it, in one period: a node of its own kind in the place of an inner node. The walk turns
// its ray into the frame of the mesh and continues at the root of that piece's tree. Elements with corners of their own form
// one more "mesh", which stands once and unturned, and whose triangles have their images.
struct BvhCopy {
  std::array<float, 3> shift;  // shared::CopyTurn, with the shift of `image` added
  std::uint32_t mark;          // all bits set, which marks a copy: other nodes have smaller exponents
  std::uint32_t root;          // node
  std::uint32_t first_element;
  std::uint32_t image;  // as in BvhTriangle
  // Added to the number of a triangle, modulo 2^32, to make its place in the order of all triangles of all copies.
  std::uint32_t order_offset;
  float cos_out, sin_out, scale;
  std::uint32_t first_counter;  // added to the counters of the triangles; filled in by the code that counts landings
  float cos_back, sin_back, per_scale;
  std::uint32_t part;            // index into Bvh::parts
  std::uint32_t first_triangle;  // of the piece, and their number
  std::uint32_t triangles;
  std::array<std::uint32_t, 2> unused;
};
static_assert(sizeof(BvhCopy) == sizeof(BvhNode));

// The triangles of a shared mesh, or of all elements with corners of their own.
struct BvhPart {
  std::uint32_t mesh = 0;  // as in ElementCorners::meshes(), or own_corners
  std::uint32_t root = 0;  // node
  std::uint32_t first_triangle = 0;
  std::uint32_t triangles = 0;
};
inline constexpr std::uint32_t own_corners = 0xffffffffU;

struct Bvh {
  std::vector<BvhNode> nodes;          // nodes[0] is the root; empty for a canopy without elements
  std::vector<BvhTriangle> triangles;  // in leaf order; all references, each once; those of a shared mesh once for all copies
  int depth = 0;                       // levels of nodes; at most max_bvh_depth
  std::vector<BvhPart> parts;          // of a tree with copies
  std::vector<std::uint32_t> copies;   // the nodes that are copies, in the order of the tree; empty for a tree without
};

// Returns whether a node stands for a copy, and reads and writes such a node.
[[nodiscard]] inline bool is_copy(const BvhNode& node) {
  return node.exponent[0] == 255;
}
[[nodiscard]] inline BvhCopy copy_at(const Bvh& bvh, std::uint32_t node) {
  return std::bit_cast<BvhCopy>(bvh.nodes[node]);
}
inline void set_copy(Bvh& bvh, std::uint32_t node, const BvhCopy& copy) {
  bvh.nodes[node] = std::bit_cast<BvhNode>(copy);
}

inline constexpr int max_bvh_depth = 30;  // the walks keep one stack entry per level

}  // namespace sunfleck

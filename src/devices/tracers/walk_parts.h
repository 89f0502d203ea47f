#pragma once
// What the walks for one ray and for a bundle of rays share: vectors, nodes and triangles. For the sources of the walks only.

#include "base/check.h"
#include "devices/tracers/cpu_walk.h"

#include <array>
#include <bit>

// The walks are compiled twice, for processors with eight lanes and for all others; the choice is made when the program starts.
// Both find the same hits: box tests need not be exact, and triangles are computed alike.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WALK_FOR_EACH_PROCESSOR [[gnu::target_clones("avx2", "default")]]
#else
#define WALK_FOR_EACH_PROCESSOR
#endif
#define INLINED [[gnu::always_inline]] inline
// Vectors cross no call boundary, since all functions that take them are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace sunfleck::walk_parts {

// Vectors with one lane per child slot, or one per ray.
using UInt8 [[gnu::vector_size(32)]] = std::uint32_t;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;
using Float8 [[gnu::vector_size(32)]] = float;

// GCC 12 would convert eight bytes at once byte by byte.
INLINED Float8 as_floats(const std::array<std::uint8_t, 8>& bytes) {
  const auto [low, high] = std::bit_cast<std::array<std::uint32_t, 2>>(bytes);
  const UInt8 words{low, low, low, low, high, high, high, high};
  const UInt8 lanes = (words >> UInt8{0, 8, 16, 24, 0, 8, 16, 24}) & 255U;
  return __builtin_convertvector(std::bit_cast<Int8>(lanes), Float8);
}

// Returns a bit mask of the lanes in which a comparison holds.
INLINED unsigned bits_of(const Int8& holds) {
  Int8 bits = holds & Int8{1, 2, 4, 8, 16, 32, 64, 128};
  bits |= __builtin_shufflevector(bits, bits, 4, 5, 6, 7, 0, 1, 2, 3);
  bits |= __builtin_shufflevector(bits, bits, 2, 3, 0, 1, 6, 7, 4, 5);
  bits |= __builtin_shufflevector(bits, bits, 1, 0, 3, 2, 5, 4, 7, 6);
  return static_cast<unsigned>(bits[0]);
}

// How rays cross the boxes of all nodes.
struct BoxPath {
  float inverse[3];
  bool back[3];
  unsigned octant;  // 4, 2 and 1 for the axes x, y and z along which the rays travel backwards, added up
};

INLINED BoxPath box_path(const shared::Ray& ray) {
  BoxPath path{{ray.inverse.x, ray.inverse.y, ray.inverse.z}, {}, 0};
  for (unsigned axis = 0; axis < 3; ++axis) {
    path.back[axis] = path.inverse[axis] < 0.0F;
    if (path.back[axis]) path.octant |= 4U >> axis;
  }
  return path;
}

// Computes for each child slot where its box is entered, before `limit`, by the earlier of two rays that start along each axis at
// `foremost` and `hindmost`; a single ray starts at both. Returns the bits of the slots that are entered before the other leaves.
INLINED unsigned enter_children(const BvhNode& node, const BoxPath& path, const float (&foremost)[3],
                                const float (&hindmost)[3], float limit, Float8& enter) {
  const std::array<std::uint8_t, 8>* const lo[3] = {&node.lo_x, &node.lo_y, &node.lo_z};
  const std::array<std::uint8_t, 8>* const hi[3] = {&node.hi_x, &node.hi_y, &node.hi_z};
  enter = Float8{};
  Float8 leave = Float8{} + limit;
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = std::bit_cast<float>(std::uint32_t{node.exponent[axis]} << 23U) * path.inverse[axis];
    const float early = (node.origin[axis] - foremost[axis]) * path.inverse[axis];
    const float late = (node.origin[axis] - hindmost[axis]) * path.inverse[axis];
    const Float8 first = as_floats(*(path.back[axis] ? hi : lo)[axis]) * scale + early;
    const Float8 last = as_floats(*(path.back[axis] ? lo : hi)[axis]) * scale + late;
    enter = first > enter ? first : enter;
    leave = last < leave ? last : leave;
  }
  return bits_of(enter <= leave);
}

// A node still to visit, and where the ray enters it.
struct Visit {
  std::uint32_t node;
  float enter;
};
using VisitStack = std::array<Visit, 8 * max_bvh_depth>;

// Orders the slots of a mask roughly along the ray: bit (k XOR octant) for slot k.
INLINED unsigned along_ray(unsigned slots, unsigned octant) {
  if ((octant & 1U) != 0) slots = (slots & 0x55U) << 1U | (slots >> 1U & 0x55U);
  if ((octant & 2U) != 0) slots = (slots & 0x33U) << 2U | (slots >> 2U & 0x33U);
  if ((octant & 4U) != 0) slots = (slots & 0x0fU) << 4U | slots >> 4U;
  return slots;
}

// Calls test(triangle number) for each triangle of the leaves among the slots `met`, near ones first.
template <class Test>
INLINED void for_triangles(const BvhNode& node, unsigned met, unsigned octant, const Test& test) {
  for (unsigned leaves = along_ray(met & ~unsigned{node.inner_mask}, octant); leaves != 0;) {
    const unsigned bit = 31U - static_cast<unsigned>(std::countl_zero(leaves));
    leaves &= ~(1U << bit);
    const unsigned slot = bit ^ octant;
    const std::uint32_t first = node.triangle_base + (node.meta[slot] & 31U);
    const auto triangles = static_cast<std::uint32_t>(std::popcount(static_cast<unsigned>(node.meta[slot] >> 5U)));
    for (std::uint32_t k = first; k < first + triangles; ++k) test(k);
  }
}

// Puts the inner nodes among the slots `met` on the stack unless they are entered past `limit`; the nearest comes to lie on top.
INLINED void push_inner(const BvhNode& node, unsigned met, unsigned octant, const Float8& enter, float limit, VisitStack& stack,
                        std::size_t& depth) {
  for (unsigned inner = along_ray(met & node.inner_mask, octant); inner != 0; inner &= inner - 1) {  // far ones first
    const unsigned slot = static_cast<unsigned>(std::countr_zero(inner)) ^ octant;
    if (enter[slot] > limit) continue;
    const auto below = static_cast<unsigned>(std::popcount(node.inner_mask & ((1U << slot) - 1U)));
    DCHECK(depth, <, stack.size());
    stack[depth++] = {node.child_base + below, enter[slot]};
  }
}

inline glm::vec3 corner(const std::array<float, 3>& at) {
  return {at[0], at[1], at[2]};
}

// Vector with one lane per corner.
using Int4 [[gnu::vector_size(16)]] = std::int32_t;
using Long2 [[gnu::vector_size(16)]] = std::int64_t;
using Float4 [[gnu::vector_size(16)]] = float;

// A ray as shared::meet_triangle sees it, with its axes already in order.
struct EdgeRay {
  std::size_t x, y, z;
  float origin[3];
  float shear_x, shear_y;
};

INLINED EdgeRay edge_ray(const shared::Ray& ray) {
  const std::size_t z = ray.axis;
  const std::size_t x = z == 2 ? 0 : z + 1;
  const std::size_t y = x == 2 ? 0 : x + 1;
  const float origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
  return {x, y, z, {origin[x], origin[y], origin[z]}, ray.shear.x, ray.shear.y};
}

INLINED bool any_of(Int4 holds) {
  const Long2 halves = std::bit_cast<Long2>(holds);
  return (halves[0] | halves[1]) != 0;
}

// Returns false only if shared::meet_triangle finds the ray outside the edges: computes the same u, v and w in parallel.
INLINED bool within_edges(const EdgeRay& ray, const BvhTriangle& t) {
  const Float4 z = Float4{t.a[ray.z], t.b[ray.z], t.c[ray.z], ray.origin[2]} - ray.origin[2];
  const Float4 x = Float4{t.a[ray.x], t.b[ray.x], t.c[ray.x], ray.origin[0]} - ray.origin[0] - ray.shear_x * z;
  const Float4 y = Float4{t.a[ray.y], t.b[ray.y], t.c[ray.y], ray.origin[1]} - ray.origin[1] - ray.shear_y * z;
  const Float4 x_cab = __builtin_shufflevector(x, x, 2, 0, 1, 3);
  const Float4 y_cab = __builtin_shufflevector(y, y, 2, 0, 1, 3);
  const Float4 x_bca = __builtin_shufflevector(x, x, 1, 2, 0, 3);
  const Float4 y_bca = __builtin_shufflevector(y, y, 1, 2, 0, 3);
  const Float4 uvw = x_cab * y_bca - y_cab * x_bca;
  return !(any_of(uvw < 0.0F) && any_of(uvw > 0.0F));
}

// What to add to the numbers of a triangle; nothing in a tree without copies.
struct Numbering {
  std::uint32_t first_element = 0;
  std::uint32_t image = 0;
  std::uint32_t order_offset = 0;
  std::uint32_t copy = 0;  // node
};

inline Numbering numbering_of(const BvhCopy& copy, std::uint32_t node) {
  return {copy.first_element, copy.image, copy.order_offset, node};
}

// Keeps the better of `best` and the hit on one reference.
inline void meet(const Bvh& bvh, std::uint32_t triangle, const shared::Ray& ray, float limit, OwnElement own,
                 const Numbering& add, CpuHit& best) {
  const BvhTriangle& reference = bvh.triangles[triangle];
  const std::uint32_t element = reference.element + add.first_element;
  if (element == own.element && (reference.image | add.image) == own.image) return;
  const shared::TriangleHit hit = shared::meet_triangle(ray, corner(reference.a), corner(reference.b), corner(reference.c));
  if (!hit.met || hit.t > limit) return;
  const std::uint32_t place = triangle + add.order_offset;
  if (!shared::hit_precedes({hit.t, element, place}, {best.t, best.element, best.triangle})) return;
  best = {true, hit.t, hit.weight_b, hit.weight_c, hit.lower, element, place, triangle, add.copy};
}

inline CpuHit no_hit(float limit) {
  CpuHit best;
  best.t = limit;
  best.element = shared::no_element;
  return best;
}

}  // namespace sunfleck::walk_parts

#include "devices/tracers/cpu_walk.h"

#include "base/check.h"

#include <array>
#include <bit>

// The walk is compiled twice, for processors with eight lanes and for all others; the choice is made when the program starts.
// Both find the same hits: box tests need not be exact, and triangles are computed alike.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WALK_FOR_EACH_PROCESSOR [[gnu::target_clones("avx2", "default")]]
#else
#define WALK_FOR_EACH_PROCESSOR
#endif
#define INLINED [[gnu::always_inline]] inline
// Vectors cross no call boundary, since all functions that take them are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace sunfleck {
namespace {

// Vector with one lane per child slot.
using UInt8 [[gnu::vector_size(32)]] = std::uint32_t;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;
using Float8 [[gnu::vector_size(32)]] = float;
// Vector with one lane per corner.
using Int4 [[gnu::vector_size(16)]] = std::int32_t;
using Long2 [[gnu::vector_size(16)]] = std::int64_t;
using Float4 [[gnu::vector_size(16)]] = float;

glm::vec3 corner(const std::array<float, 3>& at) {
  return {at[0], at[1], at[2]};
}

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

INLINED bool any(Int4 holds) {
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
  return !(any(uvw < 0.0F) && any(uvw > 0.0F));
}

// What to add to the numbers of a triangle; nothing in a tree without copies.
struct Numbering {
  std::uint32_t first_element = 0;
  std::uint32_t image = 0;
  std::uint32_t order_offset = 0;
  std::uint32_t copy = 0;  // node
};

// Keeps the better of `best` and the hit on one reference.
void meet(const Bvh& bvh, std::uint32_t triangle, const shared::Ray& ray, float limit, OwnElement own, const Numbering& add,
          CpuHit& best) {
  const BvhTriangle& reference = bvh.triangles[triangle];
  const std::uint32_t element = reference.element + add.first_element;
  if (element == own.element && (reference.image | add.image) == own.image) return;
  const shared::TriangleHit hit = shared::meet_triangle(ray, corner(reference.a), corner(reference.b), corner(reference.c));
  if (!hit.met || hit.t > limit) return;
  const std::uint32_t place = triangle + add.order_offset;
  if (!shared::hit_precedes({hit.t, element, place}, {best.t, best.element, best.triangle})) return;
  best = {true, hit.t, hit.weight_b, hit.weight_c, hit.lower, element, place, triangle, add.copy};
}

Numbering numbering_of(const BvhCopy& copy, std::uint32_t node) {
  return {copy.first_element, copy.image, copy.order_offset, node};
}

CpuHit no_hit(float limit) {
  CpuHit best;
  best.t = limit;
  best.element = shared::no_element;
  return best;
}

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

// A ray in the form used for the boxes of all nodes.
struct BoxRay {
  float origin[3];
  float inverse[3];
  bool back[3];
  unsigned octant;
};

INLINED BoxRay box_ray(const shared::Ray& ray) {
  BoxRay result{{ray.origin.x, ray.origin.y, ray.origin.z},
                {ray.inverse.x, ray.inverse.y, ray.inverse.z},
                {ray.inverse.x < 0.0F, ray.inverse.y < 0.0F, ray.inverse.z < 0.0F},
                0};
  result.octant = (result.back[0] ? 4U : 0U) | (result.back[1] ? 2U : 0U) | (result.back[2] ? 1U : 0U);
  return result;
}

// Computes for each child slot where the ray enters its box. Returns the bits of the slots that it enters before `limit`.
INLINED unsigned enter_children(const BvhNode& node, const BoxRay& ray, float limit, Float8& enter) {
  const std::array<std::uint8_t, 8>* const lo[3] = {&node.lo_x, &node.lo_y, &node.lo_z};
  const std::array<std::uint8_t, 8>* const hi[3] = {&node.hi_x, &node.hi_y, &node.hi_z};
  enter = Float8{};
  Float8 leave = Float8{} + limit;
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = std::bit_cast<float>(std::uint32_t{node.exponent[axis]} << 23U) * ray.inverse[axis];
    const float base = (node.origin[axis] - ray.origin[axis]) * ray.inverse[axis];
    const Float8 first = as_floats(*(ray.back[axis] ? hi : lo)[axis]) * scale + base;
    const Float8 last = as_floats(*(ray.back[axis] ? lo : hi)[axis]) * scale + base;
    enter = first > enter ? first : enter;
    leave = last < leave ? last : leave;
  }
  return bits_of(enter <= leave);
}

struct Visit {
  std::uint32_t node;
  float enter;
};

// Orders the slots of a mask roughly along the ray: bit (k XOR octant) for slot k.
INLINED unsigned along_ray(unsigned slots, unsigned octant) {
  if ((octant & 1U) != 0) slots = (slots & 0x55U) << 1U | (slots >> 1U & 0x55U);
  if ((octant & 2U) != 0) slots = (slots & 0x33U) << 2U | (slots >> 2U & 0x33U);
  if ((octant & 4U) != 0) slots = (slots & 0x0fU) << 4U | slots >> 4U;
  return slots;
}

// Walks the tree below `root`. A tree of copies calls enter_copy(node number) for each copy that the ray may meet.
template <bool of_copies, class EnterCopy>
INLINED void walk(const Bvh& bvh, std::uint32_t root, const shared::Ray& ray, float limit, Images images, OwnElement own,
                  const Numbering& add, CpuHit& best, const EnterCopy& enter_copy) {
  const BoxRay along = box_ray(ray);
  const EdgeRay edges = edge_ray(ray);
  std::array<Visit, 8 * max_bvh_depth> stack;
  std::size_t depth = 0;
  stack[depth++] = {root, 0.0F};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.enter > best.t) continue;
    const BvhNode& node = bvh.nodes[visit.node];
    if constexpr (of_copies) {
      if (is_copy(node)) {
        enter_copy(visit.node);
        continue;
      }
    }
    Float8 enter;
    const unsigned met = enter_children(node, along, best.t, enter);
    for (unsigned leaves = along_ray(met & ~unsigned{node.inner_mask}, along.octant); leaves != 0;) {  // near ones first
      const unsigned bit = 31U - static_cast<unsigned>(std::countl_zero(leaves));
      leaves &= ~(1U << bit);
      const unsigned slot = bit ^ along.octant;
      const std::uint32_t first = node.triangle_base + (node.meta[slot] & 31U);
      const auto triangles = static_cast<std::uint32_t>(std::popcount(static_cast<unsigned>(node.meta[slot] >> 5U)));
      for (std::uint32_t k = first; k < first + triangles; ++k) {
        const BvhTriangle& triangle = bvh.triangles[k];
        if (!within_edges(edges, triangle)) continue;
        if (images == Images::all || triangle.image == 0) meet(bvh, k, ray, limit, own, add, best);
      }
    }
    for (unsigned inner = along_ray(met & node.inner_mask, along.octant); inner != 0; inner &= inner - 1) {  // far ones first
      const unsigned slot = static_cast<unsigned>(std::countr_zero(inner)) ^ along.octant;
      if (enter[slot] > best.t) continue;
      const auto below = static_cast<unsigned>(std::popcount(node.inner_mask & ((1U << slot) - 1U)));
      DCHECK(depth, <, stack.size());
      stack[depth++] = {node.child_base + below, enter[slot]};
    }
  }
}

}  // namespace

shared::CopyTurn turn_of(const BvhCopy& copy) {
  return {corner(copy.shift), copy.cos_out, copy.sin_out, copy.scale, copy.cos_back, copy.sin_back, copy.per_scale};
}

CpuHit nearest_hit_of_all(const Bvh& bvh, const shared::Ray& ray, float limit, OwnElement own) {
  CpuHit best = no_hit(limit);
  for (const std::uint32_t node : bvh.copies) {
    const BvhCopy copy = copy_at(bvh, node);
    const shared::Ray turned = shared::turned_ray(turn_of(copy), ray);
    for (std::uint32_t k = copy.first_triangle; k < copy.first_triangle + copy.triangles; ++k) {
      meet(bvh, k, turned, limit, own, numbering_of(copy, node), best);
    }
  }
  if (!bvh.copies.empty()) return best;
  for (std::uint32_t k = 0; k < bvh.triangles.size(); ++k) meet(bvh, k, ray, limit, own, {}, best);
  return best;
}

WALK_FOR_EACH_PROCESSOR
CpuHit nearest_hit(const Bvh& bvh, const shared::Ray& ray, float limit, Images images, OwnElement own) {
  CpuHit best = no_hit(limit);
  if (bvh.nodes.empty()) return best;
  const auto no_copies = [](std::uint32_t) {};
  if (bvh.copies.empty()) {
    walk<false>(bvh, 0, ray, limit, images, own, {}, best, no_copies);
    return best;
  }
  walk<true>(
      bvh, 0, ray, limit, images, own, {}, best, [&](std::uint32_t node) __attribute__((always_inline)) {
        const BvhCopy copy = copy_at(bvh, node);
        if (images == Images::originals && copy.image != 0) return;
        walk<false>(bvh, copy.root, shared::turned_ray(turn_of(copy), ray), limit, images, own, numbering_of(copy, node), best,
                    no_copies);
      });
  return best;
}

}  // namespace sunfleck

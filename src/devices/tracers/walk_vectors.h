// The tests of boxes and edges in vectors, by Google Highway: each source that includes this file is compiled once for each kind
// of processor, and the best is chosen when the program starts. Box tests need not be exact; triangles are computed by the same
// operations in the same order as by shared::meet_triangle. All kinds therefore find the same hits to the last bit.
// For the sources of the walks only. The guard toggles, because each of Highway's passes needs the file anew.
#if defined(SUNFLECK_WALK_VECTORS) == defined(HWY_TARGET_TOGGLE)
#ifdef SUNFLECK_WALK_VECTORS
#undef SUNFLECK_WALK_VECTORS
#else
#define SUNFLECK_WALK_VECTORS
#endif

#include "devices/tracers/walk_parts.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sunfleck::walk_parts::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Returns a bit mask of the lanes in which a comparison holds; there are at most 16.
template <class D, class Mask>
HWY_INLINE unsigned bits_of(D lanes, Mask holds) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(lanes, holds, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
}

// Returns what stands in those slots of eight, from `first_slot` on, for which `met` holds: the bits of BvhNode::meta.
template <class D, class Mask>
HWY_INLINE std::uint32_t children_in(D /*slots*/, const BvhNode& node, std::size_t first_slot, Mask met) {
  const hn::RebindToUnsigned<D> words;
  const auto meta = hn::PromoteTo(words, hn::LoadU(hn::Rebind<std::uint8_t, D>(), node.meta.data() + first_slot));
  const auto bits = hn::Shl(hn::ShiftRight<5>(meta), hn::And(meta, hn::Set(words, 31U)));
  return hn::GetLane(hn::SumOfLanes(words, hn::IfThenElseZero(hn::RebindMask(words, met), bits)));  // no bit stands twice
}

// Computes for each child slot where its box is entered, before `limit`, by the earlier of two rays that start along each axis at
// `foremost` and `hindmost`; a single ray starts at both. Returns the triangles and inner nodes of the slots that are entered
// before the other leaves, as the bits of BvhNode::meta.
HWY_INLINE std::uint32_t enter_children(const BvhNode& node, const BoxPath& path, const PointLanes& foremost,
                                        const PointLanes& hindmost, float limit, std::array<float, 8>& enter) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&node);
  alignas(16) float per_byte[4];
  alignas(16) float early[4];
  alignas(16) float late[4];
  const hn::CappedTag<float, 4> axes;
  for (std::size_t i = 0; i < 4; i += hn::Lanes(axes)) {
    const auto exponent =
        hn::PromoteTo(hn::Rebind<std::int32_t, decltype(axes)>(),
                      hn::LoadU(hn::Rebind<std::uint8_t, decltype(axes)>(), bytes + offsetof(BvhNode, exponent) + i));
    const auto origin = hn::LoadU(axes, reinterpret_cast<const float*>(bytes) + i);
    const auto inverse = hn::Load(axes, path.inverse.data() + i);
    hn::Store(hn::Mul(hn::BitCast(axes, hn::ShiftLeft<23>(exponent)), inverse), axes, per_byte + i);
    hn::Store(hn::Mul(hn::Sub(origin, hn::Load(axes, foremost.at.data() + i)), inverse), axes, early + i);
    hn::Store(hn::Mul(hn::Sub(origin, hn::Load(axes, hindmost.at.data() + i)), inverse), axes, late + i);
  }
  const hn::CappedTag<float, 8> slots;
  const hn::Rebind<std::uint8_t, decltype(slots)> slot_bytes;
  const hn::Rebind<std::int32_t, decltype(slots)> slot_words;
  std::uint32_t met = 0;
  for (std::size_t i = 0; i < 8; i += hn::Lanes(slots)) {
    auto first = hn::Zero(slots);
    auto last = hn::Set(slots, limit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto scale = hn::Set(slots, per_byte[axis]);
      const auto near = hn::ConvertTo(slots, hn::PromoteTo(slot_words, hn::LoadU(slot_bytes, bytes + path.near_at[axis] + i)));
      const auto far = hn::ConvertTo(slots, hn::PromoteTo(slot_words, hn::LoadU(slot_bytes, bytes + path.far_at[axis] + i)));
      first = hn::Max(first, hn::MulAdd(near, scale, hn::Set(slots, early[axis])));
      last = hn::Min(last, hn::MulAdd(far, scale, hn::Set(slots, late[axis])));
    }
    hn::StoreU(first, slots, enter.data() + i);
    met |= children_in(slots, node, i, hn::Le(first, last));
  }
  return met;
}

// Returns false only if shared::meet_triangle finds the ray outside the edges: computes the same u, v and w in parallel, each
// with the other sign, which changes no rounding.
HWY_INLINE bool within_edges([[maybe_unused]] const EdgeRay& ray, [[maybe_unused]] const BvhTriangle& triangle) {
#if HWY_TARGET == HWY_SCALAR
  return true;
#else
  const hn::FixedTag<float, 4> lanes;
  const auto origin = hn::Load(lanes, ray.origin.at.data());
  const auto* const words = reinterpret_cast<const float*>(&triangle);  // each corner with another word behind it
  const auto a = hn::Sub(hn::LoadU(lanes, words), origin);
  const auto b = hn::Sub(hn::LoadU(lanes, words + 4), origin);
  const auto c = hn::Sub(hn::LoadU(lanes, words + 8), origin);
  const auto ab_xy = hn::InterleaveLower(lanes, a, b);
  const auto cc_xy = hn::InterleaveLower(lanes, c, c);
  alignas(16) float corners[3][4];  // by axis: a, b, c, c
  hn::Store(hn::ConcatLowerLower(lanes, cc_xy, ab_xy), lanes, corners[0]);
  hn::Store(hn::ConcatUpperUpper(lanes, cc_xy, ab_xy), lanes, corners[1]);
  hn::Store(hn::ConcatLowerLower(lanes, hn::InterleaveUpper(lanes, c, c), hn::InterleaveUpper(lanes, a, b)), lanes, corners[2]);
  const auto z = hn::Load(lanes, corners[ray.axes.z]);
  const auto x = hn::Sub(hn::Load(lanes, corners[ray.axes.x]), hn::Mul(hn::Set(lanes, ray.shear_x), z));
  const auto y = hn::Sub(hn::Load(lanes, corners[ray.axes.y]), hn::Mul(hn::Set(lanes, ray.shear_y), z));
  const auto areas = hn::Sub(hn::Mul(x, hn::Shuffle0321(y)), hn::Mul(y, hn::Shuffle0321(x)));  // the third is 0
  const auto zero = hn::Zero(lanes);
  const unsigned none_negative = hn::AllFalse(lanes, hn::Lt(areas, zero)) ? 1U : 0U;
  const unsigned none_positive = hn::AllFalse(lanes, hn::Gt(areas, zero)) ? 1U : 0U;
  return (none_negative | none_positive) != 0;  // without a branch, which the processor would often guess wrong
#endif
}

// Returns the bits of the lanes whose rays are outside the edges: computes u, v and w as shared::meet_triangle does.
template <class D, class V>
HWY_INLINE unsigned outside_edges(D lanes, const EdgeAxes& axes, const BvhTriangle& t, V origin_x, V origin_y, V origin_z,
                                  V shear_x, V shear_y) {
  const auto zero = hn::Zero(lanes);
  const auto az = hn::Sub(hn::Set(lanes, t.a[axes.z]), origin_z);
  const auto bz = hn::Sub(hn::Set(lanes, t.b[axes.z]), origin_z);
  const auto cz = hn::Sub(hn::Set(lanes, t.c[axes.z]), origin_z);
  const auto ax = hn::Sub(hn::Sub(hn::Set(lanes, t.a[axes.x]), origin_x), hn::Mul(shear_x, az));
  const auto ay = hn::Sub(hn::Sub(hn::Set(lanes, t.a[axes.y]), origin_y), hn::Mul(shear_y, az));
  const auto bx = hn::Sub(hn::Sub(hn::Set(lanes, t.b[axes.x]), origin_x), hn::Mul(shear_x, bz));
  const auto by = hn::Sub(hn::Sub(hn::Set(lanes, t.b[axes.y]), origin_y), hn::Mul(shear_y, bz));
  const auto cx = hn::Sub(hn::Sub(hn::Set(lanes, t.c[axes.x]), origin_x), hn::Mul(shear_x, cz));
  const auto cy = hn::Sub(hn::Sub(hn::Set(lanes, t.c[axes.y]), origin_y), hn::Mul(shear_y, cz));
  const auto u = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
  const auto v = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
  const auto w = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));
  const auto some_negative = hn::Or(hn::Or(hn::Lt(u, zero), hn::Lt(v, zero)), hn::Lt(w, zero));
  const auto some_positive = hn::Or(hn::Or(hn::Gt(u, zero), hn::Gt(v, zero)), hn::Gt(w, zero));
  return bits_of(lanes, hn::And(some_negative, some_positive));
}

}  // namespace sunfleck::walk_parts::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

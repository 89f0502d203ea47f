#include "devices/tracers/fan_walk.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "devices/tracers/fan_walk.cpp"
#include <hwy/foreach_target.h>

#include "devices/tracers/walk_vectors.h"

HWY_BEFORE_NAMESPACE();
namespace sunfleck::HWY_NAMESPACE {

using namespace walk_parts;
using namespace walk_parts::HWY_NAMESPACE;

// Sets of rays are bits: bit k for ray k.
HWY_INLINE std::uint32_t first_of(unsigned set) {
  return static_cast<std::uint32_t>(std::countr_zero(set));
}

// Returns those rays of a set that can be tested together: those that travel into the same octant as the first and have the
// same axis.
HWY_INLINE unsigned alike(const RayFan& fan, unsigned set) {
  const auto kind = [&](std::uint32_t ray) HWY_ATTR {
    const shared::Ray& along = fan.along[ray];
    return along.axis << 3U | (along.inverse.x < 0.0F ? 4U : 0U) | (along.inverse.y < 0.0F ? 2U : 0U) |
           (along.inverse.z < 0.0F ? 1U : 0U);
  };
  const std::uint32_t wanted = kind(first_of(set));
  unsigned result = 0;
  for (std::uint32_t ray = 0; ray < fan.rays; ++ray) result |= (kind(ray) == wanted ? 1U : 0U) << ray;
  return result & set;
}

// Calls visit(set) for sets of rays that are alike, until all rays of a set had their turn.
template <class Visit>
HWY_INLINE void for_alike(const RayFan& fan, unsigned set, const Visit& visit) {
  while (set != 0) {
    const unsigned some = alike(fan, set);
    visit(some);
    set &= ~some;
  }
}

// A number of each ray of a set, in the ray's lane; other lanes repeat the first ray.
struct Lanes {
  alignas(64) float of[rays_per_bundle];
};

// The rays of a set side by side, by axis.
struct SetLanes {
  Lanes origin[3], inverse[3], shear_x, shear_y;
};

HWY_INLINE SetLanes lanes_of(const RayFan& fan, unsigned set) {
  SetLanes result;
  for (std::uint32_t lane = 0; lane < rays_per_bundle; ++lane) {
    const shared::Ray& ray = fan.along[(set >> lane & 1U) != 0 ? lane : first_of(set)];
    for (int axis = 0; axis < 3; ++axis) {
      result.origin[axis].of[lane] = ray.origin[axis];
      result.inverse[axis].of[lane] = ray.inverse[axis];
    }
    result.shear_x.of[lane] = ray.shear.x;
    result.shear_y.of[lane] = ray.shear.y;
  }
  return result;
}

struct Range {
  float lo, hi;
};

HWY_INLINE Range range_of(const Lanes& numbers) {
  const hn::CappedTag<float, rays_per_bundle> lanes;
  auto lo = hn::Load(lanes, numbers.of);
  auto hi = lo;
  for (std::size_t i = hn::Lanes(lanes); i < rays_per_bundle; i += hn::Lanes(lanes)) {
    const auto some = hn::Load(lanes, numbers.of + i);
    lo = hn::Min(lo, some);
    hi = hn::Max(hi, some);
  }
  return {hn::GetLane(hn::MinOfLanes(lanes, lo)), hn::GetLane(hn::MaxOfLanes(lanes, hi))};
}

// The range of the rays of a set along each axis: the origin furthest along the rays, from which a box is reached first, the one
// furthest behind, and the reciprocals of the directions.
struct BoxRays {
  PointLanes foremost, hindmost;
  PointLanes least, most;
};

HWY_INLINE BoxRays box_rays(const SetLanes& rays, const BoxPath& path) {
  BoxRays result;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const Range origin = range_of(rays.origin[axis]);
    const Range inverse = range_of(rays.inverse[axis]);
    result.foremost.at[axis] = path.back[axis] ? origin.lo : origin.hi;
    result.hindmost.at[axis] = path.back[axis] ? origin.hi : origin.lo;
    result.least.at[axis] = inverse.lo;
    result.most.at[axis] = inverse.hi;
  }
  for (PointLanes* const point : {&result.foremost, &result.hindmost, &result.least, &result.most}) point->at[3] = 1.0F;
  return result;
}

// As for parallel rays, but each plane is reached by the direction of the range that is first or last to do so, which depends on
// whether the plane lies ahead. Rounding errors are those of a single ray, for which boxes are padded.
HWY_INLINE std::uint32_t enter_children(const BvhNode& node, const BoxPath& path, const BoxRays& rays, float limit,
                                        std::array<float, 8>& enter) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&node);
  alignas(16) float scale[4];
  alignas(16) float early[4];
  alignas(16) float late[4];
  const hn::CappedTag<float, 4> axes;
  for (std::size_t i = 0; i < 4; i += hn::Lanes(axes)) {
    const auto exponent =
        hn::PromoteTo(hn::Rebind<std::int32_t, decltype(axes)>(),
                      hn::LoadU(hn::Rebind<std::uint8_t, decltype(axes)>(), bytes + offsetof(BvhNode, exponent) + i));
    const auto origin = hn::LoadU(axes, reinterpret_cast<const float*>(bytes) + i);
    hn::Store(hn::BitCast(axes, hn::ShiftLeft<23>(exponent)), axes, scale + i);
    hn::Store(hn::Sub(origin, hn::Load(axes, rays.foremost.at.data() + i)), axes, early + i);
    hn::Store(hn::Sub(origin, hn::Load(axes, rays.hindmost.at.data() + i)), axes, late + i);
  }
  const hn::CappedTag<float, 8> slots;
  const hn::Rebind<std::uint8_t, decltype(slots)> slot_bytes;
  const hn::Rebind<std::int32_t, decltype(slots)> slot_words;
  const auto plane = [&](std::uint32_t at) HWY_ATTR {
    return hn::ConvertTo(slots, hn::PromoteTo(slot_words, hn::LoadU(slot_bytes, bytes + at)));
  };
  std::uint32_t met = 0;
  for (std::uint32_t i = 0; i < 8; i += static_cast<std::uint32_t>(hn::Lanes(slots))) {
    auto first = hn::Zero(slots);
    auto last = hn::Set(slots, limit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto size = hn::Set(slots, scale[axis]);
      const auto least = hn::Set(slots, rays.least.at[axis]);
      const auto most = hn::Set(slots, rays.most.at[axis]);
      const auto near = hn::MulAdd(plane(path.near_at[axis] + i), size, hn::Set(slots, early[axis]));
      const auto far = hn::MulAdd(plane(path.far_at[axis] + i), size, hn::Set(slots, late[axis]));
      first = hn::Max(first, hn::Min(hn::Mul(near, least), hn::Mul(near, most)));
      last = hn::Min(last, hn::Max(hn::Mul(far, least), hn::Mul(far, most)));
    }
    hn::StoreU(first, slots, enter.data() + i);
    met |= children_in(slots, node, i, hn::Le(first, last));
  }
  return met;
}

// Returns the rays of the set that are not outside the edges.
HWY_INLINE unsigned within_edges(const SetLanes& rays, const EdgeAxes& axes, unsigned set, const BvhTriangle& triangle) {
  const hn::CappedTag<float, rays_per_bundle> lanes;
  unsigned outside = 0;
  for (std::size_t i = 0; i < rays_per_bundle; i += hn::Lanes(lanes)) {
    outside |= outside_edges(lanes, axes, triangle, hn::Load(lanes, rays.origin[axes.x].of + i),
                             hn::Load(lanes, rays.origin[axes.y].of + i), hn::Load(lanes, rays.origin[axes.z].of + i),
                             hn::Load(lanes, rays.shear_x.of + i), hn::Load(lanes, rays.shear_y.of + i))
               << i;
  }
  return set & ~outside;
}

// Returns how far the ray of the set that can still gain most looks.
HWY_INLINE float furthest(const BundleHits& hits, unsigned set) {
  float result = hits[first_of(set)].t;
  for (unsigned left = set; left != 0; left &= left - 1) result = std::max(result, hits[first_of(left)].t);
  return result;
}

// Walks the tree below `root` with rays that are alike. A tree of copies calls enter_copy(node number) for each copy that a ray
// may meet.
template <bool of_copies, class EnterCopy>
HWY_INLINE void walk(const Bvh& bvh, std::uint32_t root, const RayFan& fan, unsigned set, Images images, const Numbering& add,
                     BundleHits& hits, const EnterCopy& enter_copy) {
  const shared::Ray& first = fan.along[first_of(set)];
  const BoxPath path = box_path(first);
  const EdgeAxes axes = edge_axes(first);
  const SetLanes rays = lanes_of(fan, set);
  const BoxRays boxes = box_rays(rays, path);
  float limit = furthest(hits, set);
  VisitStack stack;
  std::uint32_t at = root;
  do {
    const BvhNode& node = bvh.nodes[at];
    if constexpr (of_copies) {
      if (is_copy(node)) {
        enter_copy(at);
        limit = furthest(hits, set);
        continue;
      }
    }
    const std::uint32_t met = enter_children(node, path, boxes, limit, stack.next().enter);
    for_triangles(node, met, [&](std::uint32_t triangle) HWY_ATTR {
      const BvhTriangle& reference = bvh.triangles[triangle];
      if (images == Images::originals && reference.image != 0) return;
      const unsigned within = within_edges(rays, axes, set, reference);
      if (within == 0) return;
      for (unsigned left = within; left != 0; left &= left - 1) {
        const std::uint32_t ray = first_of(left);
        meet(bvh, triangle, fan.along[ray], fan.limits[ray], {}, add, hits[ray]);
      }
      limit = furthest(hits, set);
    });
    stack.push(node, met, path.nearest);
  } while (stack.pop(path.nearest, limit, 0, at));
}

// Returns the fan in the frame of a copy's mesh.
RayFan turned_fan(const shared::CopyTurn& turn, const RayFan& fan) {
  RayFan turned = fan;
  for (std::uint32_t ray = 0; ray < fan.rays; ++ray) turned.along[ray] = shared::turned_ray(turn, fan.along[ray]);
  return turned;
}

void nearest_of_fan(const Bvh& bvh, const RayFan& fan, Images images, BundleHits& hits) {
  for (std::uint32_t ray = 0; ray < fan.rays; ++ray) hits[ray] = no_hit(fan.limits[ray]);
  if (bvh.nodes.empty()) return;
  const auto no_copies = [](std::uint32_t) {};
  for_alike(fan, (1U << fan.rays) - 1U, [&](unsigned set) HWY_ATTR {
    if (bvh.copies.empty()) return walk<false>(bvh, 0, fan, set, images, {}, hits, no_copies);
    walk<true>(bvh, 0, fan, set, images, {}, hits, [&](std::uint32_t node) HWY_ATTR {
      const BvhCopy copy = copy_at(bvh, node);
      if (images == Images::originals && copy.image != 0) return;
      const RayFan turned = turned_fan(turn_of(copy), fan);
      for_alike(turned, set, [&](unsigned some) HWY_ATTR {
        walk<false>(bvh, copy.root, turned, some, images, numbering_of(copy, node), hits, no_copies);
      });
    });
  });
}

}  // namespace sunfleck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sunfleck {

HWY_EXPORT(nearest_of_fan);

void nearest_hits(const Bvh& bvh, const RayFan& fan, Images images, BundleHits& hits) {
  HWY_DYNAMIC_DISPATCH(nearest_of_fan)(bvh, fan, images, hits);
}

}  // namespace sunfleck
#endif

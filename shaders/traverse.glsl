// The walk over the tree: finds the nearest hit of one ray in one period, with a fixed stack and a count of its steps. With
// SKIP_OWN the copy `own_image` of element `own_element` is left out. With ONLY_ORIGINALS elements are met only at their
// place in the canopy, not where their copies reach into the period.

#include "shared/turn.h"

// Whether the tree has nodes that stand for copies of a mesh; see BvhCopy.
layout(constant_id = 3) const bool has_copies = false;

const uint max_depth = 32u;  // at least max_bvh_depth

struct NearestHit {
  float t;
  float weight_b;
  float weight_c;
  uint lower;
  uint element;
  uint triangle;   // place in leaf order, counting the triangles of each copy
  uint reference;  // index of the triangle
  uint copy;       // the first word of the node of the copy, if has_copies
  bool found;
};

// What to add to the numbers of a triangle; nothing in a tree without copies.
struct Numbering {
  uint first_element;
  uint image;
  uint order_offset;
  uint copy;
};
const uint no_copy = 0xffffffffu;
const Numbering unchanged = Numbering(0u, 0u, 0u, no_copy);

CopyTurn turn_of(uint copy) {
  vec4 shift = uintBitsToFloat(NODE_WORDS(copy));
  vec4 outwards = uintBitsToFloat(NODE_WORDS(copy + 2u));
  vec4 back = uintBitsToFloat(NODE_WORDS(copy + 3u));
  return CopyTurn(shift.xyz, outwards.x, outwards.y, outwards.z, back.x, back.y, back.z);
}

bool is_copy(uvec4 head) { return (head.w & 0xffu) == 255u; }

uint octant_of(Ray ray) {
  return (ray.inverse.x < 0.0 ? 4u : 0u) | (ray.inverse.y < 0.0 ? 2u : 0u) | (ray.inverse.z < 0.0 ? 1u : 0u);
}

// Returns the group that holds the root of a tree alone.
uvec2 group_of_root(uint node) { return uvec2(node, 0x80000000u); }

vec3 corner_of(uvec4 words) { return uintBitsToFloat(words.xyz); }

// Returns a mask with bit k (or, for leaf children, the bits of their triangles) set where the ray may meet something in the
// child; see BvhNode.
uint meet_children(Ray ray, float limit, uvec4 head, uvec4 meta, uvec4 planes_a, uvec4 planes_b, uvec4 planes_c, uint octant) {
  vec3 corner = uintBitsToFloat(head.xyz);
  vec3 cell = vec3(uintBitsToFloat((head.w & 0xffu) << 23u), uintBitsToFloat((head.w >> 8u & 0xffu) << 23u),
                   uintBitsToFloat((head.w >> 16u & 0xffu) << 23u));
  vec3 scale = cell * ray.inverse;
  vec3 base = (corner - ray.origin) * ray.inverse;
  bool back_x = ray.inverse.x < 0.0;
  bool back_y = ray.inverse.y < 0.0;
  bool back_z = ray.inverse.z < 0.0;
  uint met = 0u;
  for (uint half_of = 0u; half_of < 2u; ++half_of) {
    bool first = half_of == 0u;
    uint lo_x = first ? planes_a.x : planes_a.y;
    uint lo_y = first ? planes_a.z : planes_a.w;
    uint lo_z = first ? planes_b.x : planes_b.y;
    uint hi_x = first ? planes_b.z : planes_b.w;
    uint hi_y = first ? planes_c.x : planes_c.y;
    uint hi_z = first ? planes_c.z : planes_c.w;
    uint meta4 = first ? meta.z : meta.w;
    uint near_x = back_x ? hi_x : lo_x;
    uint near_y = back_y ? hi_y : lo_y;
    uint near_z = back_z ? hi_z : lo_z;
    uint far_x = back_x ? lo_x : hi_x;
    uint far_y = back_y ? lo_y : hi_y;
    uint far_z = back_z ? lo_z : hi_z;
    for (uint shift = 0u; shift < 32u; shift += 8u) {
      float enter_x = float(near_x >> shift & 0xffu) * scale.x + base.x;
      float enter_y = float(near_y >> shift & 0xffu) * scale.y + base.y;
      float enter_z = float(near_z >> shift & 0xffu) * scale.z + base.z;
      float leave_x = float(far_x >> shift & 0xffu) * scale.x + base.x;
      float leave_y = float(far_y >> shift & 0xffu) * scale.y + base.y;
      float leave_z = float(far_z >> shift & 0xffu) * scale.z + base.z;
      float enter = enter_x > enter_y ? enter_x : enter_y;
      enter = enter_z > enter ? enter_z : enter;
      enter = enter > 0.0 ? enter : 0.0;
      float leave = leave_x < leave_y ? leave_x : leave_y;
      leave = leave_z < leave ? leave_z : leave;
      leave = limit < leave ? limit : leave;
      uint meta_k = meta4 >> shift & 0xffu;
      uint place = meta_k & 31u;
      place = place >= 24u ? place ^ octant : place;
      met |= enter <= leave ? meta_k >> 5u << place : 0u;
    }
  }
  return met;
}

// Completes the best hit. The walk leaves this to the end, since only one of many hits needs it.
NearestHit finished_hit(Ray ray, HitRank best, uint copy) {
  NearestHit hit;
  hit.t = best.t;
  hit.element = best.element;
  hit.triangle = best.triangle;
  hit.reference = best.triangle;
  hit.copy = copy;
  hit.found = best.element != no_element;
  if (has_copies && hit.found) {
    hit.reference = best.triangle - NODE_WORDS(copy + 1u).w;
    ray = turned_ray(turn_of(copy), ray);
  }
  uint first = 3u * hit.reference;
  TriangleHit met = meet_triangle(ray, corner_of(TRIANGLE_WORDS(first)), corner_of(TRIANGLE_WORDS(first + 1u)),
                                  corner_of(TRIANGLE_WORDS(first + 2u)));
  hit.weight_b = met.weight_b;
  hit.weight_c = met.weight_c;
  hit.lower = met.lower;
  return hit;
}

// A group holds the children of a node that are still to be visited: the index of the first, then a bit for each (24 and up)
// and the mask of inner children.
bool is_empty(uvec2 group) { return group.y <= 0x00ffffffu; }

// Returns the nearest hit with 0 < t <= limit. `steps` keeps counting across calls; a walk that reaches
// `steps_in_one_dispatch` stops unfinished. Each step visits a node and tests a triangle of some node visited before, so
// that invocations running side by side do both together. In a loop over the triangles of each node all would wait for the
// invocation that has most of them (on lavapipe the walk takes a fourth less time than such a loop).
#ifdef SKIP_OWN
NearestHit nearest_hit(Ray ray, float limit, uint own_element, uint own_image, inout uint steps) {
#else
NearestHit nearest_hit(Ray ray, float limit, inout uint steps) {
#endif
  HitRank best = HitRank(limit, no_element, 0u);
  uint copy_of_best = no_copy;
  Ray along = ray;  // as the tree sees it that is walked: that of the copies, or the one of a mesh
  Numbering add = unchanged;
  uint octant = octant_of(along);
  uvec2 stack[max_depth];
  uint depth = 0u;
  uint outer_depth = 0u;  // of the groups of copies on the stack while a copy is walked
  uvec2 group = group_of_root(0u);
  uvec2 triangles = uvec2(0u);  // to be tested: node of the first one, then a bit for each; zero in both if there are none
  uvec2 triangles_after = uvec2(0u);
  ++steps;  // counts an iteration of the caller's loop over periods
  while (steps < steps_in_one_dispatch) {
    ++steps;
    if (!is_empty(group) && triangles_after.y == 0u) {
      uint bit = uint(findMSB(group.y));
      uint slot = (bit - 24u) ^ octant;
      group.y &= ~(1u << bit);
      uint node = 5u * (group.x + uint(bitCount(group.y & 0xffu & ((1u << slot) - 1u))));
      uvec4 head = NODE_WORDS(node);
      uvec4 meta = NODE_WORDS(node + 1u);
      if (has_copies && is_copy(head)) {
#ifdef ONLY_ORIGINALS
        bool walked = meta.z == 0u;
#else
        bool walked = true;
#endif
        if (walked) {
          if (!is_empty(group) && depth < max_depth) stack[depth++] = group;
          outer_depth = depth;
          add = Numbering(meta.y, meta.z, meta.w, node);
          along = turned_ray(turn_of(node), ray);
          octant = octant_of(along);
          group = group_of_root(meta.x);
        }
      } else {
        uvec4 planes_a = NODE_WORDS(node + 2u);
        uvec4 planes_b = NODE_WORDS(node + 3u);
        uvec4 planes_c = NODE_WORDS(node + 4u);
        uint met = meet_children(along, best.t, head, meta, planes_a, planes_b, planes_c, octant);
        uint leaves = met & 0x00ffffffu;
        if (leaves != 0u) triangles_after = uvec2(meta.y, leaves);
        if (met > 0x00ffffffu) {
          if (!is_empty(group) && depth < max_depth) stack[depth++] = group;
          group = uvec2(meta.x, (met & 0xff000000u) | (head.w >> 24u));
        }
      }
      if (is_empty(group) && depth > outer_depth) group = stack[--depth];
    }
    if (triangles.y == 0u) {
      triangles = triangles_after;
      triangles_after = uvec2(0u);
    }
    if (triangles.y != 0u) {
      uint triangle = triangles.x + uint(findLSB(triangles.y));
      triangles.y &= triangles.y - 1u;
      if (triangles.y == 0u) triangles.x = 0u;
      uvec4 a = TRIANGLE_WORDS(3u * triangle);
      uvec4 b = TRIANGLE_WORDS(3u * triangle + 1u);
      TriangleHit hit = meet_triangle(along, corner_of(a), corner_of(b), corner_of(TRIANGLE_WORDS(3u * triangle + 2u)));
      uint element = a.w + add.first_element;
#ifdef SKIP_OWN
      hit.met = hit.met && (element != own_element || (b.w | add.image) != own_image);
#endif
#ifdef ONLY_ORIGINALS
      hit.met = hit.met && b.w == 0u;
#endif
      HitRank rank = HitRank(hit.t, element, triangle + add.order_offset);
      if (hit.met && hit.t <= limit && hit_precedes(rank, best)) {
        best = rank;
        copy_of_best = add.copy;
      }
    }
    if (is_empty(group) && (triangles.y | triangles_after.y) == 0u) {
      if (!has_copies || depth == 0u) break;
      group = stack[--depth];
      along = ray;
      octant = octant_of(ray);
      outer_depth = 0u;
      add = unchanged;
    }
  }
  return finished_hit(ray, best, copy_of_best);
}

// Ray-triangle intersection, watertight: Woop, Benthin & Wald 2013, "Watertight ray/triangle intersection", JCGT 2(1).
// Neighbouring triangles compute the same two products for their common edge and subtract them in opposite order, so a ray
// passes on exactly one side of the edge or meets both triangles; there is no gap, and double precision is not needed.
#ifndef SUNFLECK_SHARED_INTERSECT_H
#define SUNFLECK_SHARED_INTERSECT_H

#include "shared/exact.h"

SHARED_BEGIN

struct Ray {
  vec3 origin;
  vec3 direction;  // any length
  vec3 inverse;    // direction_reciprocal of each component
  vec3 shear;      // sx, sy, sz of the paper
  uint axis;       // the paper's kz: where |direction| is largest
};

struct TriangleHit {
  float t;         // along the ray, in lengths of its direction
  float weight_b;  // barycentric
  float weight_c;
  uint lower;  // 1: the ray met the lower face
  bool met;
};

// Returns the vector with its component `axis` last and the others in cyclic order.
INLINE vec3 axis_last(vec3 v, uint axis) {
  return axis == 0u ? vec3(v.y, v.z, v.x) : (axis == 1u ? vec3(v.z, v.x, v.y) : v);
}

INLINE Ray make_ray(vec3 origin, vec3 direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.inverse = vec3(direction_reciprocal(direction.x), direction_reciprocal(direction.y), direction_reciprocal(direction.z));
  const float x = magnitude(direction.x);
  const float y = magnitude(direction.y);
  const float z = magnitude(direction.z);
  ray.axis = x > y ? (x > z ? 0u : 2u) : (y > z ? 1u : 2u);
  const vec3 d = axis_last(direction, ray.axis);
  const float scale = exact_reciprocal(d.z);
  EXACT float sx = d.x * scale;
  EXACT float sy = d.y * scale;
  ray.shear = vec3(sx, sy, scale);
  return ray;
}

// Returns the hit with t > 0, edges included; an edge-on triangle is not hit.
INLINE TriangleHit meet_triangle(Ray ray, vec3 corner_a, vec3 corner_b, vec3 corner_c) {
  TriangleHit hit;
  hit.met = false;
  hit.t = 0.0f;
  hit.weight_b = 0.0f;
  hit.weight_c = 0.0f;
  hit.lower = 0u;
  EXACT vec3 to_a = corner_a - ray.origin;
  EXACT vec3 to_b = corner_b - ray.origin;
  EXACT vec3 to_c = corner_c - ray.origin;
  const vec3 a = axis_last(to_a, ray.axis);
  const vec3 b = axis_last(to_b, ray.axis);
  const vec3 c = axis_last(to_c, ray.axis);
  EXACT float ax = a.x - ray.shear.x * a.z;
  EXACT float ay = a.y - ray.shear.y * a.z;
  EXACT float bx = b.x - ray.shear.x * b.z;
  EXACT float by = b.y - ray.shear.y * b.z;
  EXACT float cx = c.x - ray.shear.x * c.z;
  EXACT float cy = c.y - ray.shear.y * c.z;
  EXACT float u = cx * by - cy * bx;
  EXACT float v = ax * cy - ay * cx;
  EXACT float w = bx * ay - by * ax;
  const bool some_negative = u < 0.0f || v < 0.0f || w < 0.0f;
  const bool some_positive = u > 0.0f || v > 0.0f || w > 0.0f;
  if (some_negative && some_positive) return hit;
  EXACT float determinant = u + v + w;
  if (magnitude(determinant) < 1e-30f) return hit;
  EXACT float az = ray.shear.z * a.z;
  EXACT float bz = ray.shear.z * b.z;
  EXACT float cz = ray.shear.z * c.z;
  EXACT float distance = u * az + v * bz + w * cz;
  const float inverse = exact_reciprocal(determinant);
  EXACT float t = distance * inverse;
  EXACT float weight_b = v * inverse;
  EXACT float weight_c = w * inverse;
  hit.t = t;
  hit.weight_b = weight_b;
  hit.weight_c = weight_c;
  hit.lower = (determinant > 0.0f) == (ray.shear.z > 0.0f) ? 0u : 1u;
  hit.met = t > 0.0f;
  return hit;
}

// The order of competing hits: the nearer wins, at equal distance the lower element number and, between copies of one
// element that lie in each other's plane, the one that comes first in the tree.
struct HitRank {
  float t;
  uint element;
  uint triangle;  // position in leaf order
};

INLINE bool hit_precedes(HitRank hit, HitRank other) {
  if (hit.t != other.t) return hit.t < other.t;
  return hit.element < other.element || (hit.element == other.element && hit.triangle < other.triangle);
}

SHARED_END

#endif

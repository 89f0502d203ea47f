// Camera rays, and which surface number belongs to what they meet.
#ifndef SUNFLECK_SHARED_VIEW_H
#define SUNFLECK_SHARED_VIEW_H

#include "shared/beam.h"

SHARED_BEGIN

// Through the point (x, y) of the picture, 0..1 from the left and from the top. Its length is such that t is the depth along
// the forward axis.
INLINE vec3 view_direction(ViewBlock view, float x, float y) {
  EXACT float across = 2.0f * x - 1.0f;
  EXACT float up = 1.0f - 2.0f * y;
  EXACT float dx = view.forward.x + (view.right.x * across + view.up.x * up);
  EXACT float dy = view.forward.y + (view.right.y * across + view.up.y * up);
  EXACT float dz = view.forward.z + (view.right.z * across + view.up.z * up);
  return vec3(dx, dy, dz);
}

// Where the ray begins: no farther from the scene than needed, since the boxes of the tree are padded for rounding errors over
// lengths of its own size.
INLINE vec3 view_origin(ViewBlock view, vec3 direction) {
  EXACT float x = view.position.x + view.start * direction.x;
  EXACT float y = view.position.y + view.start * direction.y;
  EXACT float z = view.position.z + view.start * direction.z;
  return vec3(x, y, z);
}

INLINE float view_depth(ViewBlock view, float t) {
  EXACT float depth = view.start + t;
  return depth;
}

// Where sample `number` of the picture lies; `offset` is its place in the pixel, 0..1.
INLINE vec2 sample_point(ViewBlock view, uint number, vec2 offset, float per_width, float per_height) {
  const uint pixel = number / view.samples;
  const uint row = pixel / view.width;
  EXACT float x = (float(pixel - row * view.width) + offset.x) * per_width;
  EXACT float y = (float(row) + offset.y) * per_height;
  return vec2(x, y);
}

// The ground as the camera sees it: where the ray meets it inside the plot; t <= 0 where it does not.
INLINE float seen_ground(Ray ray, GroundMap ground) {
  if (ground.cells_x == 0u) return 0.0f;
  EXACT float t = (ground.y - ray.origin.y) * ray.inverse.y;
  return t > 0.0f && in_plot(ground, ground_point(ray, t)) ? t : 0.0f;
}

// How far a ray that meets the ground at `t` looks for elements, so that one lying in the ground is seen.
INLINE float ground_limit(Ray ray, GroundMap ground, float t) {
  EXACT float slack = ground.depth * magnitude(ray.inverse.y);
  EXACT float limit = t + slack;
  return t > 0.0f ? limit : 1e30f;
}

SHARED_END

#endif

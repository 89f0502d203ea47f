// Camera rays, and the surfaces that they see.
#ifndef SUNFLECK_SHARED_VIEW_H
#define SUNFLECK_SHARED_VIEW_H

#include "shared/beam.h"
#include "shared/view_layout.h"

SHARED_BEGIN

// Returns `from`, moved to the point (x, y) of the picture, 0..1 from the left and from the top.
INLINE vec3 in_picture(ViewBlock view, vec3 from, float x, float y) {
  EXACT float across = 2.0f * x - 1.0f;
  EXACT float up = 1.0f - 2.0f * y;
  EXACT vec3 at = from + (view.right * vec3(across) + view.up * vec3(up));
  return at;
}

// Returns the direction of the ray through the point (x, y) of the picture; not for a fisheye. Its length is such that t is the
// depth along the forward axis.
INLINE vec3 view_direction(ViewBlock view, float x, float y) {
  return view.kind == view_orthographic ? view.forward : in_picture(view, view.forward, x, y);
}

// Returns the point of the camera through which the ray of (x, y) passes.
INLINE vec3 view_position(ViewBlock view, float x, float y) {
  return view.kind != view_orthographic ? view.position : in_picture(view, view.position, x, y);
}

// Returns the start of the ray. It is no farther from the scene than needed, since the boxes of the tree are padded for
// rounding errors over lengths of the tree's own size.
INLINE vec3 view_origin(ViewBlock view, vec3 position, vec3 direction) {
  return point_along(position, direction, view.start);
}

INLINE float view_depth(ViewBlock view, float t) {
  EXACT float depth = view.start + t;
  return depth;
}

// Returns the position of a sample in the picture; `number` counts from the first sample of the row `first_row`, `offset` is
// the sample's place in the pixel, 0..1.
INLINE vec2 sample_point(ViewBlock view, uint first_row, uint number, vec2 offset, float per_width, float per_height) {
  const uint pixel = number / view.samples;
  const uint row = pixel / view.width;
  EXACT float x = (float(pixel - row * view.width) + offset.x) * per_width;
  EXACT float y = (float(first_row + row) + offset.y) * per_height;
  return vec2(x, y);
}

// Returns t where the ray meets the ground inside the plot, as the camera sees it; t <= 0 if it does not.
INLINE float seen_ground(Ray ray, GroundMap ground) {
  if (ground.cells_x == 0u) return 0.0f;
  EXACT float t = (ground.y - ray.origin.y) * ray.inverse.y;
  return t > 0.0f && in_plot(ground, ground_point(ray, t)) ? t : 0.0f;
}

// Returns the distance past the ground at which an element lying in it is still seen, although the ray meets the ground a
// little earlier.
INLINE float ground_slack(Ray ray, GroundMap ground) {
  EXACT float slack = ground.depth * magnitude(ray.inverse.y);
  return slack;
}

// Returns how far a ray that meets the ground at `t` is followed to find elements.
INLINE float ground_limit(float t, float slack) {
  EXACT float limit = t + slack;
  return t > 0.0f ? limit : 1e30f;
}

// Returns how far the ray is followed if a surface in another copy of the plot was seen already.
INLINE float kept_limit(ViewBlock view, SeenSurface kept, float slack, float limit) {
  EXACT float t = (kept.depth - view.start) + slack;
  return kept.surface != seen_nothing && t < limit ? t : limit;
}

// Returns true if the found surface replaces the one seen in another copy of the plot: the nearer wins, and an element wins
// over the ground also where it lies in it.
INLINE bool replaces(ViewBlock view, SeenSurface found, SeenSurface kept, float slack) {
  if (found.surface == seen_nothing) return false;
  if (kept.surface == seen_nothing) return true;
  const bool found_ground = found.surface >= 2u * view.elements;
  const bool kept_ground = kept.surface >= 2u * view.elements;
  EXACT float kept_to = kept.depth + slack;
  EXACT float found_to = found.depth + slack;
  if (found_ground && !kept_ground) return found_to < kept.depth;
  if (kept_ground && !found_ground) return found.depth <= kept_to;
  return found.depth < kept.depth;
}

SHARED_END

#endif

#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Each thread follows one sample of a pixel and finds the side that the camera sees. Copies of the plot are searched one
// after the other, and the nearest hit is kept.

#define ONLY_ORIGINALS
#include "shared/view.h"
#include "tree.glsl"
#include "traverse.glsl"

layout(local_size_x = group_size) in;

layout(set = 0, binding = 2, scalar) readonly buffer Views { ViewBlock views[]; };  // [copy]
layout(set = 0, binding = 3, scalar) readonly buffer Offsets { vec2 offsets[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Directions { vec3 directions[]; };  // of a fisheye; 0 outside its circle
layout(set = 0, binding = 5, scalar) buffer Seen { SeenSurface seen[]; };
layout(push_constant, scalar) uniform Push { ViewPush push; };

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= push.count) return;
  ViewBlock view = views[push.copy];
  SeenSurface kept = SeenSurface(seen_nothing, 0.0, 0u);
  if (push.copy > 0u) kept = seen[place];
  if (kept.surface == seen_unfinished) return;

  uint number = push.first + place;
  vec2 at = sample_point(view, push.first_row, number, offsets[number % view.samples], exact_reciprocal(float(view.width)),
                         exact_reciprocal(float(view.height)));
  vec3 direction = view.kind == view_fisheye ? directions[place] : view_direction(view, at.x, at.y);
  if (direction == vec3(0.0)) {
    seen[place] = kept;
    return;
  }
  Ray ray = make_ray(view_origin(view, view_position(view, at.x, at.y), direction), direction);
  float ground_t = seen_ground(ray, view.ground);
  float slack = ground_slack(ray, view.ground);
  uint steps = 0u;
  NearestHit hit = nearest_hit(ray, kept_limit(view, kept, slack, ground_limit(ground_t, slack)), steps);
  SeenSurface found = SeenSurface(seen_nothing, 0.0, push.copy);
  if (hit.found) {
    found = SeenSurface(2u * hit.element + hit.lower, view_depth(view, hit.t), push.copy);
  } else if (ground_t > 0.0) {
    found = SeenSurface(2u * view.elements + soil_cell(view.ground, ground_point(ray, ground_t)), view_depth(view, ground_t),
                        push.copy);
  }
  if (replaces(view, found, kept, slack)) kept = found;
  if (steps >= steps_in_one_dispatch) kept.surface = seen_unfinished;
  seen[place] = kept;
}

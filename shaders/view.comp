#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One thread, one sample of a pixel: which side does the camera see?

#define ONLY_ORIGINALS
#include "shared/view.h"
#include "tree.glsl"
#include "traverse.glsl"

layout(local_size_x = group_size) in;

layout(set = 0, binding = 2, scalar) readonly buffer View { ViewBlock view; };
layout(set = 0, binding = 3, scalar) readonly buffer Offsets { vec2 offsets[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Seen { SeenSurface seen[]; };
layout(push_constant, scalar) uniform Push { ViewPush push; };

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  uint number = push.first + gl_GlobalInvocationID.x;
  vec2 at = sample_point(view, number, offsets[number % view.samples], exact_reciprocal(float(view.width)),
                         exact_reciprocal(float(view.height)));
  vec3 direction = view_direction(view, at.x, at.y);
  Ray ray = make_ray(view_origin(view, direction), direction);
  float ground_t = seen_ground(ray, view.ground);
  uint steps = 0u;
  NearestHit hit = nearest_hit(ray, ground_limit(ray, view.ground, ground_t), steps);
  SeenSurface result = SeenSurface(seen_nothing, 0.0);
  if (steps >= steps_in_one_dispatch) {
    result.surface = seen_unfinished;
  } else if (hit.found) {
    result = SeenSurface(2u * hit.element + hit.lower, view_depth(view, hit.t));
  } else if (ground_t > 0.0) {
    result = SeenSurface(2u * view.elements + soil_cell(view.ground, ground_point(ray, ground_t)),
                         view_depth(view, ground_t));
  }
  seen[gl_GlobalInvocationID.x] = result;
}

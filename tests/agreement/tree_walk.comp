#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Runs the walk over the tree alone, for sparse_plot_test.cpp: one thread follows one ray through one period.

#include "shared_text.h"
#include "tree.glsl"
#include "traverse.glsl"

layout(local_size_x = group_size) in;
layout(set = 0, binding = 2, scalar) readonly buffer Rays { WalkedRay rays[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Hits { WalkedHit hits[]; };
layout(push_constant, scalar) uniform Push { TextPush push; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  uint steps = 0u;
  NearestHit hit = nearest_hit(make_ray(rays[i].origin, push.direction), rays[i].limit, steps);
  hits[i] = WalkedHit(hit.t, hit.weight_b, hit.weight_c, hit.lower, hit.element,
                      steps >= steps_in_one_dispatch ? 2u : (hit.found ? 1u : 0u));
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Adds up, for each column, the coefficients of what is scattered where the sampled rays of the beam landed. Each thread takes
// a ray.

#include "landing_place.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= pass.sampled.count) return;
  Landing landing = landings[sampled_ray(pass.sampled, gl_GlobalInvocationID.x)];
  if (landing.surface > landed_on_ground) return;
  uint first = (pass.faces + place_of(landing).face) * pass.columns;
  uint copy = own_copy();
  for (uint c = 0u; c < pass.columns; ++c) {
    if (faces[first + c] != uint64_t(0u)) add_to_row(copy, sum_weights, c, faces[first + c]);
  }
}

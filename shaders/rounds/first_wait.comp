#version 460
#extension GL_GOOGLE_include_directive : require
// Lets flux wait where the sampled rays of the beam landed; these places follow those that the host has sent. Each thread takes
// a ray.

#include "landing_place.glsl"

#include "shared/random.h"

void main() {
  if (gl_GlobalInvocationID.x >= pass.sampled.count) return;
  uint number = state.places - pass.sampled.count + gl_GlobalInvocationID.x;
  Landing landing = landings[sampled_ray(pass.sampled, gl_GlobalInvocationID.x)];
  bool landed = landing.surface <= landed_on_ground;
  bool any = false;
  for (uint c = 0u; c < pass.columns; ++c) {
    uint64_t own = landed ? columns[c].at_point : uint64_t(0u);
    next_quanta[number * pass.columns + c] = own;
    if (own != uint64_t(0u)) any = true;
  }
  WaitingPlace place = no_place();
  if (any) {
    place = place_of(landing);
    place.u = random_words(pass.key, pass.sample_word + gl_GlobalInvocationID.x, 0u).x;
    keep_place(own_copy(), place.order);
  }
  next_places[number] = place;
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Moves the places to their parts. Each thread takes the run that it took in count.comp.

#include "pass.glsl"
#include "place_part.glsl"

void main() {
  uint run = gl_GlobalInvocationID.x;
  uint runs = run_count();
  if (run >= runs) return;
  uint next[place_parts];
  for (uint part = 0u; part < place_parts; ++part) next[part] = uint(sum_before(part * runs + run));
  uint end = min(state.places, (run + 1u) * pass.choices.places_per_run);
  for (uint k = run * pass.choices.places_per_run; k < end; ++k) {
    WaitingPlace place = next_places[k];
    uint part = part_of_place(place.order);
    uint to = next[part];
    next[part] = to + 1u;
    places[to] = place;
    for (uint c = 0u; c < pass.columns; ++c) quanta[to * pass.columns + c] = next_quanta[k * pass.columns + c];
  }
}

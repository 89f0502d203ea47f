#version 460
#extension GL_GOOGLE_include_directive : require
// Counts the places of each part. Each thread takes a run of neighbouring places; sums[part * runs + run] becomes its number.

#include "pass.glsl"
#include "place_part.glsl"

void main() {
  uint run = gl_GlobalInvocationID.x;
  uint runs = run_count();
  if (run >= runs) return;
  uint counts[place_parts];
  for (uint part = 0u; part < place_parts; ++part) counts[part] = 0u;
  uint end = min(state.places, (run + 1u) * pass.choices.places_per_run);
  for (uint k = run * pass.choices.places_per_run; k < end; ++k) ++counts[part_of_place(next_places[k].order)];
  for (uint part = 0u; part < place_parts; ++part) sums[part * runs + run] = uint64_t(counts[part]);
}

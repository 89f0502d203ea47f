#version 460
#extension GL_GOOGLE_include_directive : require
// Counts the places of each part. Each group takes a run of neighbouring places; sums[part * runs + run] becomes their number.

#include "pass.glsl"
#include "place_part.glsl"

shared uint counts[place_parts];

void main() {
  uint thread = gl_LocalInvocationID.x;
  for (uint part = thread; part < place_parts; part += round_group_size) counts[part] = 0u;
  barrier();
  uint k = gl_GlobalInvocationID.x;
  if (k < state.places) atomicAdd(counts[part_of_place(next_places[k].order)], 1u);
  barrier();
  uint runs = run_count();
  for (uint part = thread; part < place_parts; part += round_group_size) {
    sums[part * runs + gl_WorkGroupID.x] = uint64_t(counts[part]);
  }
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Moves the places to their parts. Each group takes the run that it took in count.comp, and each thread a place of it.

#include "pass.glsl"
#include "place_part.glsl"

shared uint parts[round_group_size];

void main() {
  uint thread = gl_LocalInvocationID.x;
  uint k = gl_GlobalInvocationID.x;
  uint own = k < state.places ? part_of_place(next_places[k].order) : place_parts;
  parts[thread] = own;
  barrier();
  if (own == place_parts) return;
  uint to = uint(sum_before(own * run_count() + gl_WorkGroupID.x));
  for (uint other = 0u; other < thread; ++other) to += parts[other] == own ? 1u : 0u;
  places[to] = next_places[k];
  for (uint c = 0u; c < pass.columns; ++c) quanta[to * pass.columns + c] = next_quanta[k * pass.columns + c];
}

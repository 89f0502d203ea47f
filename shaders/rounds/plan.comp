#version 460
#extension GL_GOOGLE_include_directive : require
// Finds how many packets are drawn. `count` is the number of blocks of the running sums. One thread does it.

#include "pass.glsl"

void main() {
  if (gl_GlobalInvocationID.x != 0u || state.done != 0u) return;
  uint64_t sum = block_sums[push.count];
  if (sum < least_sum) return;
  uint64_t pace = uint64_t(1u) << 32u;
  uint64_t least = long_quotient(least_packets, uint64_t(0u), sum) + uint64_t(1u);
  state.gain = pace > least ? pace : least;
  state.packets = uint(drawn_up_to(sum, state.gain, state.offset));
}

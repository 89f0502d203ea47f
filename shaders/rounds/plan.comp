#version 460
#extension GL_GOOGLE_include_directive : require
// Finds how many packets are drawn. One thread does it.

#include "pass.glsl"

void main() {
  if (gl_GlobalInvocationID.x != 0u || is_at_rest()) return;
  uint64_t sum = block_sums[parts_of(side_count(), numbers_per_block)];
  if (sum < least_sum) return;
  if (pass.stand.radius > 0.0 && state.rounds == 1u) {
    state.pace = long_quotient(state.unaimed >> 32u, state.unaimed << 32u, sum);
  }
  uint64_t least = long_quotient(least_packets, uint64_t(0u), sum) + uint64_t(1u);
  state.gain = state.pace > least ? state.pace : least;
  uint64_t all_drawn = drawn_up_to(sum, state.gain, state.offset);
  uint drawn = all_drawn < uint64_t(low_word) ? uint(all_drawn) : low_word;
  state.most_drawn = max(state.most_drawn, drawn);
  state.packets = min(drawn, pass.most_packets);
  state.all_packets += uint64_t(state.packets);
  set_groups(groups_of_packets, state.packets, round_group_size);
  set_groups(groups_of_traces, state.packets, pass.choices.trace_group_size);
}

#version 460
#extension GL_GOOGLE_include_directive : require
// The second step: one group turns the sums of the blocks into the sums of all blocks before each; the sum of all comes last.

#include "pass.glsl"
#include "threads_sum.glsl"

void main() {
  if (is_at_rest()) return;
  uint blocks = parts_of(summed_numbers(), numbers_per_block);
  uint each = parts_of(blocks, round_group_size);
  uint first = min(blocks, gl_LocalInvocationID.x * each);
  uint end = min(blocks, first + each);
  uint64_t sum = uint64_t(0u);
  for (uint k = first; k < end; ++k) sum += block_sums[k];
  uint64_t before = sum_of_earlier_threads(sum);
  for (uint k = first; k < end; ++k) {
    uint64_t own = block_sums[k];
    block_sums[k] = before;
    before += own;
  }
  if (gl_LocalInvocationID.x == round_group_size - 1u) block_sums[blocks] = before;
}

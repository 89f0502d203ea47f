#version 460
#extension GL_GOOGLE_include_directive : require
// The second step: one group turns the sums of the blocks into the sums of all blocks before each; the sum of all comes last.

#include "pass.glsl"

shared uint64_t of_threads[round_group_size];

void main() {
  uint thread = gl_LocalInvocationID.x;
  if (is_at_rest()) return;
  uint blocks = parts_of(summed_numbers(), pass.choices.numbers_per_sum);
  uint each = parts_of(blocks, round_group_size);
  uint first = min(blocks, thread * each);
  uint end = min(blocks, first + each);
  uint64_t sum = uint64_t(0u);
  for (uint k = first; k < end; ++k) sum += block_sums[k];
  of_threads[thread] = sum;
  barrier();
  uint64_t before = uint64_t(0u);
  for (uint k = 0u; k < thread; ++k) before += of_threads[k];
  for (uint k = first; k < end; ++k) {
    uint64_t own = block_sums[k];
    block_sums[k] = before;
    before += own;
  }
  if (thread == round_group_size - 1u) block_sums[blocks] = before;
}

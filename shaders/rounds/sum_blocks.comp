#version 460
#extension GL_GOOGLE_include_directive : require
// The first of three steps that turn numbers into running sums: each group sums up a block of them.

#include "pass.glsl"
#include "threads_sum.glsl"

void main() {
  uint first = min(summed_numbers(), gl_GlobalInvocationID.x * numbers_per_thread);
  uint end = min(summed_numbers(), first + numbers_per_thread);
  uint64_t sum = uint64_t(0u);
  for (uint k = first; k < end; ++k) sum += sums[k];
  uint64_t before = sum_of_earlier_threads(sum);
  if (gl_LocalInvocationID.x == round_group_size - 1u) block_sums[gl_WorkGroupID.x] = before + sum;
}

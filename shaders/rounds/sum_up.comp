#version 460
#extension GL_GOOGLE_include_directive : require
// The third step: each group replaces the numbers of its block by their running sums, in which each number counts.

#include "pass.glsl"
#include "threads_sum.glsl"

void main() {
  uint first = min(summed_numbers(), gl_GlobalInvocationID.x * numbers_per_thread);
  uint end = min(summed_numbers(), first + numbers_per_thread);
  uint64_t sum = uint64_t(0u);
  for (uint k = first; k < end; ++k) sum += sums[k];
  sum = block_sums[gl_WorkGroupID.x] + sum_of_earlier_threads(sum);
  for (uint k = first; k < end; ++k) {
    sum += sums[k];
    sums[k] = sum;
  }
}

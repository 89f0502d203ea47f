#version 460
#extension GL_GOOGLE_include_directive : require
// The third step: each thread replaces the numbers of its block by their running sums, in which each number counts.

#include "pass.glsl"

void main() {
  uint block = gl_GlobalInvocationID.x;
  uint first = block * pass.choices.numbers_per_sum;
  if (first >= summed_numbers()) return;
  uint end = min(summed_numbers(), first + pass.choices.numbers_per_sum);
  uint64_t sum = block_sums[block];
  for (uint k = first; k < end; ++k) {
    sum += sums[k];
    sums[k] = sum;
  }
}

#version 460
#extension GL_GOOGLE_include_directive : require
// The first of three steps that turn numbers into running sums: each thread sums up a block of them.

#include "pass.glsl"

void main() {
  uint block = gl_GlobalInvocationID.x;
  uint first = block * pass.choices.numbers_per_sum;
  if (first >= summed_numbers()) return;
  uint end = min(summed_numbers(), first + pass.choices.numbers_per_sum);
  uint64_t sum = uint64_t(0u);
  for (uint k = first; k < end; ++k) sum += sums[k];
  block_sums[block] = sum;
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Adds up the copies of the small sums and empties them. Each thread takes a word.

#include "pass.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  uint word = push.first + gl_GlobalInvocationID.x;
  uint stride = small_words(pass);
  uint64_t sum = totals[word];
  for (uint copy = 0u; copy < pass.choices.copies; ++copy) {
    sum += copies[copy * stride + word];
    copies[copy * stride + word] = uint64_t(0u);
  }
  totals[word] = sum;
}

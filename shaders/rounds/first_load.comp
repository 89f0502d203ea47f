#version 460
#extension GL_GOOGLE_include_directive : require
// Finds how many quanta landed at each point where a sampled ray of the beam landed. Each thread of one group takes some columns.

#include "pass.glsl"

void main() {
  for (uint column = gl_LocalInvocationID.x; column < pass.columns; column += round_group_size) {
    uint word = sum_weights * pass.columns + column;
    columns[column].at_point = quanta_at_point(columns[column].from_beam, totals[word]);
    totals[word] = uint64_t(0u);
  }
}

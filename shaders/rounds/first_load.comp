#version 460
#extension GL_GOOGLE_include_directive : require
// Finds what landed at each of these points. Each thread of one group takes some columns.

#include "pass.glsl"

void main() {
  for (uint column = gl_LocalInvocationID.x; column < pass.columns; column += round_group_size) {
    uint word = sum_weights * pass.columns + column;
    columns[column].at_point = quanta_at_point(columns[column].from_beam, totals[word]);
    totals[word] = uint64_t(0u);
  }
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Sets the sums to the expectation of each side; see PacketDraw. Each thread takes a side.

#include "pass.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= side_count()) return;
  uint number = gl_GlobalInvocationID.x;
  Side side = side_of(number);
  Sent sent = sent_from(side);
  uint64_t sum = uint64_t(0u);
  uint64_t largest = uint64_t(0u);
  for (uint c = 0u; c < pass.columns; ++c) {
    uint64_t landed = quanta[side.place * pass.columns + c];
    if (landed == uint64_t(0u)) continue;
    uint64_t leaves = quanta_sent(landed, sent, c);
    sum += scaled(leaves, columns[c].wanted);
    if (state.any_least == 0u) continue;
    uint64_t least = scaled(leaves, columns[c].least);
    largest = least > largest ? least : largest;
  }
  sums[number] = sum > largest ? sum : largest;
}

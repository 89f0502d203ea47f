#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the numbers of the sides from which packets are drawn. Each thread takes a side.

#include "pass.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= side_count() || state.packets == 0u) return;
  uint side = gl_GlobalInvocationID.x;
  uint first = uint(drawn_before(side));
  uint end = uint(drawn_before(side + 1u));
  end = min(min(end, first + most_numbered), state.packets);
  for (uint packet = first; packet < end; ++packet) numbers[packet] = side;
}

#version 460
#extension GL_GOOGLE_include_directive : require
// Orders packets from number `first` on by direction within windows, as packet_order.h does. Each thread takes a window. No landing depends on the order.

#include "pass.glsl"

uint sector_of(vec3 direction) {
  vec3 size = abs(direction);
  float per_share = 3.999 / max(size.x + size.y + size.z, 1e-30);
  uint octant = (direction.x < 0.0 ? 4u : 0u) | (direction.y < 0.0 ? 2u : 0u) | (direction.z < 0.0 ? 1u : 0u);
  return min(octant * 16u + uint(size.x * per_share) * 4u + uint(size.y * per_share), sectors - 1u);
}

void main() {
  uint first = gl_GlobalInvocationID.x * pass.choices.packets_per_window;
  if (first >= packets_here()) return;
  if (first == 0u) ordered_packets = packets_here();
  uint end = min(packets_here(), first + pass.choices.packets_per_window);
  uint next[sectors];
  for (uint s = 0u; s < sectors; ++s) next[s] = 0u;
  for (uint k = first; k < end; ++k) ++next[sector_of(packets[k].direction)];
  uint sum = first;
  for (uint s = 0u; s < sectors; ++s) {
    uint own = next[s];
    next[s] = sum;
    sum += own;
  }
  for (uint k = first; k < end; ++k) {
    uint sector = sector_of(packets[k].direction);
    packet_order[next[sector]] = k;
    ++next[sector];
  }
}

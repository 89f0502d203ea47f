#version 460
#extension GL_GOOGLE_include_directive : require
// Orders packets from number `first` on by direction within windows of 128, as packet_order.h does in larger ones. Each group
// takes a window, and each thread a packet of it. No landing depends on the order.

#include "pass.glsl"

uint sector_of(vec3 direction) {
  vec3 size = abs(direction);
  float per_share = 3.999 / max(size.x + size.y + size.z, 1e-30);
  uint octant = (direction.x < 0.0 ? 4u : 0u) | (direction.y < 0.0 ? 2u : 0u) | (direction.z < 0.0 ? 1u : 0u);
  return min(octant * 16u + uint(size.x * per_share) * 4u + uint(size.y * per_share), sectors - 1u);
}

shared uint sectors_of[round_group_size];

void main() {
  uint thread = gl_LocalInvocationID.x;
  uint k = gl_GlobalInvocationID.x;
  uint own = k < packets_here() ? sector_of(packets[k].direction) : sectors;
  sectors_of[thread] = own;
  barrier();
  if (k == 0u) ordered_packets = packets_here();
  if (own == sectors) return;
  uint place = gl_WorkGroupID.x * round_group_size;
  for (uint other = 0u; other < round_group_size; ++other) {
    bool is_before = sectors_of[other] < own || (sectors_of[other] == own && other < thread);
    place += is_before ? 1u : 0u;
  }
  packet_order[place] = k;
}

// Packets aimed at a small isolated stand.
#ifndef SUNFLECK_SHARED_AIM_H
#define SUNFLECK_SHARED_AIM_H

#include "shared/exact.h"

SHARED_BEGIN

// The sphere around the stand. Its radius is 0 where packets are not aimed.
struct StandSphere {
  vec3 centre;
  float radius;
};

// A place keeps at least 2^-least_aim_bits of its expected packets.
const uint least_aim_bits = 10u;

// Returns which part of 2^32 of its expected packets a place keeps. The spread of the stand's light is least if the packets for a
// unit of flux grow with the standard deviation of a packet's contribution (Neyman 1934, J. R. Stat. Soc. 97:558): here with the
// square root of its chance to meet the stand, which falls with the cube of the distance for packets from level ground. Within
// the sphere it keeps all of them.
INLINE uint64_t aimed_part(StandSphere stand, vec3 point) {
  const uint64_t all = uint64_t(1u) << 32u;
  EXACT vec3 away = point - stand.centre;
  EXACT float squared = away.x * away.x + away.y * away.y + away.z * away.z;
  EXACT float radius_squared = stand.radius * stand.radius;
  if (squared <= radius_squared) return all;
  EXACT float ratio = stand.radius * exact_inverse_root(squared);
  EXACT float part = ratio * exact_root(ratio);
  if (part >= 1.0f) return all;
  const uint64_t kept = uint64_t(uint(part * 4294967296.0f));
  const uint64_t least = all >> least_aim_bits;
  return kept > least ? kept : least;
}

SHARED_END

#endif

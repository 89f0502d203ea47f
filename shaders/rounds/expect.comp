#version 460
#extension GL_GOOGLE_include_directive : require
// Sets the sums to the expectation of each side; see PacketDraw. Each thread takes a side.

#include "pass.glsl"

#include "corners.glsl"

#include "shared/emission.h"

// Returns which part of 2^32 of its expected packets a place keeps; see PlaceAim.
uint64_t aimed_part_of(WaitingPlace place) {
  vec3 point = vec3(place.a, pass.ground.y, place.b);
  if (place.surface != landed_on_ground) {
    uint element = place.surface >> 1u;
    if ((elements[element].optics_and_role & 3u) != role_soil) return uint64_t(1u) << 32u;
    Corners corners = corners_of(element);
    vec2 at = middle_of(place.a, place.b);
    point = point_on_triangle(corners.a, corners.b, corners.c, at.x, at.y);
  }
  return aimed_part(pass.stand, point);
}

uint64_t aimed(uint64_t expected, uint place) {
  if (pass.stand.radius == 0.0 || expected == uint64_t(0u)) return expected;
  if (state.rounds == 1u) atomicAdd(state.unaimed, expected);
  return part_of(expected, aimed_part_of(places[place]), 0u);
}

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
  sums[number] = aimed(sum > largest ? sum : largest, side.place);
}

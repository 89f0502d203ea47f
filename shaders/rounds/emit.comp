#version 460
#extension GL_GOOGLE_include_directive : require
// Starts packets from number `first` on; see PacketStarts. Each thread takes one.

#include "pass.glsl"

#include "corners.glsl"

#include "shared/emission.h"

void main() {
  if (gl_GlobalInvocationID.x >= packets_here()) return;
  uint number = push.first + gl_GlobalInvocationID.x;
  WaitingPlace place = places[numbers[number] >> 1u];
  uint side = numbers[number] & 1u;
  uvec4 words = random_words(pass.key, word_of_starts, state.rounds);
  Packet packet;
  packet.origin = vec3(place.a, pass.ground.y, place.b);
  packet.element = no_element;
  packet.image = 0u;
  vec3 normal = vec3(0.0, 1.0, 0.0);
  if (place.surface != landed_on_ground) {
    packet.element = place.surface >> 1u;
    Corners corners = corners_of(packet.element);
    vec2 at = place.a == anywhere ? weights_on_lamp(number, words) : vec2(place.a, place.b);
    packet.origin = point_on_triangle(corners.a, corners.b, corners.c, at.x, at.y);
    normal = normal_of_side(corners.a, corners.b, corners.c, side);
  }
  packet.origin = point_along(packet.origin, normal, pass.offset);
  if (pass.period.x > 0.0) {
    InPeriod moved = moved_into_period(packet.origin, pass.period, pass.per_period);
    packet.origin = moved.at;
    packet.image = moved.image;
  }
  packet.direction = direction_of_packet(normal, number, words);
  packets[gl_GlobalInvocationID.x] = packet;
}

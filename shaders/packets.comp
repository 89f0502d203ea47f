#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Each thread follows one packet from its start to its landing, or out of the canopy.

#define SKIP_OWN
#include "shared/beam.h"
#include "shared/layout.h"
#include "tree.glsl"
#include "traverse.glsl"

layout(local_size_x = group_size, local_size_x_id = 2) in;
layout(constant_id = 0) const bool periodic = true;
layout(constant_id = 1) const bool has_soil = true;

layout(set = 0, binding = 2, scalar) readonly buffer Scene { PacketBlock scene; };
layout(set = 0, binding = 3, scalar) readonly buffer Packets { Packet packets[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Landings { Landing landings[]; };
// The order in which packets are followed.
layout(set = 0, binding = 5, scalar) readonly buffer PacketOrder { uint ordered_packets; uint packet_order[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Inbox { uint inbox_count; PausedPacket inbox[]; };
layout(set = 0, binding = 7, scalar) buffer Outbox { uint outbox_count; PausedPacket outbox[]; };
layout(push_constant, scalar) uniform Push { PacketPush push; };

struct Walk {
  uint packet;  // index into this dispatch's array
  uint element;
  uint image;
  uint crossings;
};

void pause(Ray ray, Walk walk, bool stuck) {
  uint place = atomicAdd(outbox_count, 1u);
  outbox[place] = PausedPacket(ray.origin, walk.crossings, walk.packet, walk.image, stuck ? 1u : 0u);
}

void land(Walk walk, NearestHit hit) {
  landings[walk.packet] = Landing(2u * hit.element + hit.lower, hit.triangle, hit.weight_b, hit.weight_c);
}

void leave(Walk walk, uint how) { landings[walk.packet] = Landing(how, 0u, 0.0, 0.0); }

void reach_ground(Walk walk, Ray ray, float t) {
  vec2 at = ground_point(ray, t);
  landings[walk.packet] = Landing(has_soil ? landed_on_ground : left_downwards, 0u, at.x, at.y);
}

void follow_in_isolated_stand(Ray ray, Walk walk) {
  bool down = ray.inverse.y < 0.0;
  Ground ground = meet_ground(ray, scene.ground);
  bool over_plot = down && falls_on_plot(ray, scene.ground);
  uint steps = 0u;
  NearestHit hit = nearest_hit(ray, over_plot ? ground.limit : 1e30, walk.element, walk.image, steps);
  if (steps >= steps_in_one_dispatch) {
    pause(ray, walk, true);
  } else if (hit.found) {
    land(walk, hit);
  } else if (over_plot) {
    reach_ground(walk, ray, ground.t);
  } else {
    leave(walk, down ? left_downwards : left_upwards);
  }
}

void follow_in_endless_canopy(Ray ray, Walk walk) {
  bool down = ray.inverse.y < 0.0;
  uint steps = 0u;
  while (steps < steps_before_pause) {
    Ground end = down ? meet_ground(ray, scene.ground) : meet_top(ray, scene.top_y);
    Crossing crossing = next_crossing(ray, scene.period, scene.overlap);
    float limit = end.limit < crossing.limit ? end.limit : crossing.limit;
    NearestHit hit = nearest_hit(ray, limit, walk.element, walk.image, steps);
    if (steps >= steps_in_one_dispatch) {
      pause(ray, walk, true);
      return;
    }
    if (hit.found) {
      land(walk, hit);
      return;
    }
    if (end.t <= crossing.t) {
      if (down) reach_ground(walk, ray, end.t);
      if (!down) leave(walk, left_upwards);
      return;
    }
    if (++walk.crossings > max_crossings) {
      leave(walk, lost_on_its_way);
      return;
    }
    ray.origin = enter_next_period(ray, crossing, scene.period);
    walk.image = image_in_next_period(walk.image, ray, crossing.along_x);
  }
  pause(ray, walk, false);
}

void main() {
  uint count = push.from_inbox != 0u ? push.count : min(push.count, ordered_packets - push.first);
  if (gl_GlobalInvocationID.x >= count) return;
  Walk walk;
  walk.crossings = 0u;
  PausedPacket paused;
  if (push.from_inbox != 0u) {
    paused = inbox[gl_GlobalInvocationID.x];
    walk.packet = paused.packet;
    walk.crossings = paused.crossings;
  } else {
    walk.packet = packet_order[push.first + gl_GlobalInvocationID.x];
  }
  Packet packet = packets[walk.packet];
  walk.element = packet.element;
  walk.image = packet.image;
  if (push.from_inbox != 0u) {
    packet.origin = paused.origin;
    walk.image = paused.image;
  }
  Ray ray = make_ray(packet.origin, packet.direction);
  if (periodic) {
    follow_in_endless_canopy(ray, walk);
  } else {
    follow_in_isolated_stand(ray, walk);
  }
}

#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Each thread follows one beam ray from its grid cell on the incidence plane to its landing, and counts it by one atomic
// increment. It also writes where the ray landed, if that is asked for.

#include "shared/beam.h"
#include "shared/layout.h"
#include "tree.glsl"
#include "traverse.glsl"

layout(local_size_x = group_size, local_size_x_id = 2) in;
layout(constant_id = 0) const bool periodic = true;
layout(constant_id = 1) const bool has_soil = true;

layout(set = 0, binding = 2, scalar) readonly buffer Beam { BeamBlock beam; };
layout(set = 0, binding = 3, scalar) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Landings { Landing landings[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Inbox { uint inbox_count; PausedRay inbox[]; };
layout(set = 0, binding = 6, scalar) buffer Outbox { uint outbox_count; PausedRay outbox[]; };
layout(push_constant, scalar) uniform Push { BeamPush push; };

void pause(Ray ray, uint crossings, uint number, bool stuck) {
  uint place = atomicAdd(outbox_count, 1u);
  outbox[place] = PausedRay(ray.origin, crossings, number, stuck ? 1u : 0u);
}

void record(uint number, Landing landing) {
  if (push.first_landing != no_landings) landings[number - push.first_landing] = landing;
}

uint layer_at(float y) { return layer_of(y, beam.layer_base_y, beam.layers_per_metre, beam.layers); }

void count_element(uint number, NearestHit hit) {
  record(number, Landing(2u * hit.element + hit.lower, hit.triangle, hit.weight_b, hit.weight_c));
  uvec4 a = TRIANGLE_WORDS(3u * hit.reference);
  uvec4 b = TRIANGLE_WORDS(3u * hit.reference + 1u);
  uvec4 c = TRIANGLE_WORDS(3u * hit.reference + 2u);
  float y_a = uintBitsToFloat(a.y);
  float y_b = uintBitsToFloat(b.y);
  float y_c = uintBitsToFloat(c.y);
  uint word = c.w;
  if (has_copies) {
    CopyTurn turn = turn_of(hit.copy);
    y_a = placed_height(turn, y_a);
    y_b = placed_height(turn, y_b);
    y_c = placed_height(turn, y_c);
    float lowest = y_a < y_b ? y_a : y_b;
    word += NODE_WORDS(hit.copy + 2u).w - 2u * layer_at(lowest < y_c ? lowest : y_c);
  }
  uint layer = layer_at(landing_y(y_a, y_b, y_c, hit.weight_b, hit.weight_c));
  atomicAdd(counters[word + 2u * layer + hit.lower], 1u);
  if (!periodic) atomicAdd(counters[counter_met], 1u);
}

void count_ground(uint number, Ray ray, float t) {
  vec2 at = ground_point(ray, t);
  record(number, Landing(has_soil ? landed_on_ground : left_downwards, 0u, at.x, at.y));
  if (!has_soil) atomicAdd(counters[counter_transmitted], 1u);
  if (has_soil) atomicAdd(counters[counter_first_cell + soil_cell(beam.ground, at)], 1u);
  if (!periodic) atomicAdd(counters[counter_met], 1u);
}

void count_end(uint number, uint counter, uint how) {
  record(number, Landing(how, 0u, 0.0, 0.0));
  atomicAdd(counters[counter], 1u);
}

void follow_in_isolated_stand(Ray ray, uint number) {
  Ground ground = meet_ground(ray, beam.ground);
  bool over_plot = falls_on_plot(ray, beam.ground);
  uint steps = 0u;
  NearestHit hit = nearest_hit(ray, over_plot ? ground.limit : 1e30, steps);
  if (steps >= steps_in_one_dispatch) {
    pause(ray, 0u, number, true);
  } else if (hit.found) {
    count_element(number, hit);
  } else if (over_plot) {
    count_ground(number, ray, ground.t);
  } else {
    count_end(number, counter_missed, left_downwards);
  }
}

void follow_in_endless_canopy(Ray ray, uint crossings, uint number) {
  uint steps = 0u;
  while (steps < steps_before_pause) {
    Ground ground = meet_ground(ray, beam.ground);
    Crossing crossing = next_crossing(ray, beam.period, beam.overlap);
    float limit = ground.limit < crossing.limit ? ground.limit : crossing.limit;
    NearestHit hit = nearest_hit(ray, limit, steps);
    if (steps >= steps_in_one_dispatch) {
      pause(ray, crossings, number, true);
      return;
    }
    if (hit.found) {
      count_element(number, hit);
      return;
    }
    if (ground.t <= crossing.t) {
      count_ground(number, ray, ground.t);
      return;
    }
    if (++crossings > max_crossings) {
      count_end(number, counter_lost, lost_on_its_way);
      return;
    }
    ray.origin = enter_next_period(ray, crossing, beam.period);
  }
  pause(ray, crossings, number, false);
}

void main() {
  if (gl_GlobalInvocationID.x >= push.count) return;
  uint number = push.first + gl_GlobalInvocationID.x;
  uint crossings = 0u;
  vec3 origin;
  if (push.from_inbox != 0u) {
    PausedRay paused = inbox[gl_GlobalInvocationID.x];
    number = paused.ray;
    crossings = paused.crossings;
    origin = paused.origin;
  } else {
    origin = beam_origin(beam, number);
  }
  Ray ray = make_ray(origin, beam.direction);
  if (periodic) {
    follow_in_endless_canopy(ray, crossings, number);
  } else {
    follow_in_isolated_stand(ray, number);
  }
}

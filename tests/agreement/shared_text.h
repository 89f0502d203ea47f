// Calls every function of the shared text, and is shared text itself: one struct for the inputs and one for the outputs.
#ifndef SUNFLECK_TESTS_SHARED_TEXT_H
#define SUNFLECK_TESTS_SHARED_TEXT_H

#include "shared/beam.h"
#include "shared/emission.h"
#include "shared/planes.h"
#include "shared/turn.h"
#include "shared/view.h"

SHARED_BEGIN

struct TextInput {
  vec3 origin;
  vec3 direction;
  vec3 a;
  vec3 b;
  vec3 c;
  vec2 period;
  vec2 overlap;
  vec2 offset;
  float divisor;
  uint number;
  uvec2 drawn;
  float size;  // by which a triangle is enlarged before its normal is found
  float far;   // a coordinate that may be many periods away
};

struct TextOutput {
  float reciprocal;
  float direction_part;
  uvec4 words;
  float unit;
  vec3 start;
  vec3 inverse;
  vec3 shear;
  uint axis;
  float t;
  float weight_b;
  float weight_c;
  uint met_lower;
  float crossing_t;
  float crossing_limit;
  uint along_x;
  vec3 entered;
  float ground_t;
  float ground_limit;
  vec2 ground_at;
  uint in_plot;
  uint cell;
  float landing;
  uint layer;
  vec2 sample_at;
  vec3 view_along;
  vec3 view_from;
  float view_depth;
  float seen_t;
  float seen_limit;
  float kept_limit;
  uint replaced;
  float inverse_root;
  float root;
  float largest;
  float power;
  vec3 resized;
  vec3 normal;
  vec2 turn;
  vec3 scattered;
  vec2 corner_weights;
  vec3 point;
  vec3 front;
  Wrapped near_x;
  Wrapped far_z;
  vec3 placed;
  vec3 turned;
  uint cell_of_plot;
  uint cell_of_period;
};

INLINE CopyTurn turn_of_text(TextInput given) {
  CopyTurn turn;
  turn.shift = given.c;
  turn.cos_out = given.a.x;
  turn.sin_out = given.a.y;
  turn.scale = given.a.z;
  turn.cos_back = given.b.x;
  turn.sin_back = given.b.y;
  turn.per_scale = given.b.z;
  return turn;
}

INLINE uint crossed_cell(TextInput given, uint is_endless) {
  ReceiverPlane plane;
  plane.y = given.a.y;
  plane.threshold_y = given.a.y;
  plane.first_cell = 5u;
  plane.cells_x = 1u + given.number % 1000u;
  plane.cells_z = 1u + given.number % 7u;
  ReceiverPlot plot;
  plot.lo = vec2(given.b.x, given.b.z);
  plot.per_size = vec2(exact_reciprocal(given.period.x), exact_reciprocal(given.period.y));
  plot.is_endless = is_endless;
  return cell_at(plane, plot, given.origin, given.direction);
}

INLINE TextOutput all_of_the_text(BeamBlock beam, ViewBlock view, TextInput given) {
  TextOutput result;
  result.reciprocal = exact_reciprocal(given.divisor);
  result.direction_part = direction_reciprocal(given.divisor);
  result.words = random_words(beam.key, given.number, 7u);
  result.unit = unit_interval(result.words.x);
  result.start = beam_origin(beam, given.number % (beam.columns * beam.rows));
  const Ray ray = make_ray(given.origin, given.direction);
  result.inverse = ray.inverse;
  result.shear = ray.shear;
  result.axis = ray.axis;
  const TriangleHit hit = meet_triangle(ray, given.a, given.b, given.c);
  result.t = hit.t;
  result.weight_b = hit.weight_b;
  result.weight_c = hit.weight_c;
  result.met_lower = (hit.met ? 2u : 0u) + hit.lower;
  const Crossing crossing = next_crossing(ray, given.period, given.overlap);
  result.crossing_t = crossing.t;
  result.crossing_limit = crossing.limit;
  result.along_x = crossing.along_x ? 1u : 0u;
  result.entered = enter_next_period(ray, crossing, given.period);
  const Ground ground = meet_ground(ray, beam.ground);
  result.ground_t = ground.t;
  result.ground_limit = ground.limit;
  result.ground_at = ground_point(ray, ground.t);
  result.in_plot = (in_plot(beam.ground, result.ground_at) ? 1u : 0u) + (falls_on_plot(ray, beam.ground) ? 2u : 0u);
  result.cell = soil_cell(beam.ground, result.ground_at);
  result.landing = landing_y(given.a.y, given.b.y, given.c.y, hit.weight_b, hit.weight_c);
  result.layer = layer_of(given.origin.y, beam.layer_base_y, beam.layers_per_metre, beam.layers);
  const uint samples = view.width * view.height * view.samples;
  result.sample_at = sample_point(view, 3u, given.number % samples, given.offset, exact_reciprocal(float(view.width)),
                                  exact_reciprocal(float(view.height)));
  result.view_along = view_direction(view, result.sample_at.x, result.sample_at.y);
  result.view_from = view_origin(view, view_position(view, result.sample_at.x, result.sample_at.y), given.direction);
  result.view_depth = view_depth(view, hit.t);
  result.seen_t = seen_ground(ray, view.ground);
  const float slack = ground_slack(ray, view.ground);
  result.seen_limit = ground_limit(result.seen_t, slack);
  const SeenSurface kept = {given.number % (2u * view.elements + 9u), result.seen_t, 0u};
  const SeenSurface found = {given.number % 7u, result.view_depth, 1u};
  result.kept_limit = kept_limit(view, kept, slack, result.seen_limit);
  result.replaced = replaces(view, found, kept, slack) ? 1u : 0u;
  const float magnitude = uintBitsToFloat(floatBitsToUint(given.divisor) & 0x7fffffffu);
  result.inverse_root = exact_inverse_root(magnitude);
  result.root = exact_root(given.divisor);
  result.largest = largest_component(given.direction);
  result.power = inverse_power_of_two(magnitude);
  const vec3 corner_b = exact_times(given.b, given.size);
  const vec3 corner_c = exact_times(given.c, given.size);
  result.resized = exact_times(given.a, given.size);
  result.normal = exact_normal(result.resized, corner_b, corner_c);
  result.turn = exact_turn(given.drawn.y);
  result.scattered = cosine_direction(result.normal, given.drawn.x, given.drawn.y);
  result.corner_weights = even_weights(given.drawn.x, given.drawn.y);
  result.point = point_on_triangle(given.a, given.b, given.c, result.corner_weights.x, result.corner_weights.y);
  result.front = point_along(result.point, result.normal, given.offset.x);
  result.near_x = wrapped_into(result.front.x, given.period.x, exact_reciprocal(given.period.x));
  result.far_z = wrapped_into(given.far, given.period.y, exact_reciprocal(given.period.y));
  result.placed = placed_point(turn_of_text(given), given.origin);
  result.turned = turned_ray(turn_of_text(given), ray).origin;
  result.cell_of_plot = crossed_cell(given, 0u);
  result.cell_of_period = crossed_cell(given, 1u);
  return result;
}

// One ray for the walk over the tree, and its result.
struct WalkedRay {
  vec3 origin;
  float limit;
};
struct WalkedHit {
  float t;
  float weight_b;
  float weight_c;
  uint lower;
  uint element;
  uint found;  // 2 means too many steps
};

struct TextPush {
  vec3 direction;  // the same for all rays
  uint count;
};

SHARED_END

#endif

// How a packet leaves a surface: its start point, and a direction from the cosine distribution.
#ifndef SUNFLECK_SHARED_EMISSION_H
#define SUNFLECK_SHARED_EMISSION_H

#include "shared/exact.h"
#include "shared/random.h"

SHARED_BEGIN

// Returns the largest magnitude among the components.
INLINE float largest_component(vec3 v) {
  const float x = magnitude(v.x);
  const float y = magnitude(v.y);
  const float z = magnitude(v.z);
  const float xy = x > y ? x : y;
  return xy > z ? xy : z;
}

// Returns the power of two that brings x, which is below 2^127, into 1 to 2.
INLINE float inverse_power_of_two(float x) {
  return uintBitsToFloat((254u << 23u) - (floatBitsToUint(x) & 0x7f800000u));
}

INLINE vec3 exact_times(vec3 v, float factor) {
  EXACT vec3 product = v * vec3(factor);
  return product;
}

// Returns the unit normal of a triangle's upper side; straight up if it has no area. Edges and normal are brought to magnitudes
// near 1 first, so that nothing underflows. The error is about 2^-22 divided by the sine of the angle between the edges, as
// much as rounding the corners to float has done to the normal of such a sliver.
INLINE vec3 exact_normal(vec3 a, vec3 b, vec3 c) {
  EXACT vec3 along_b = b - a;
  EXACT vec3 along_c = c - a;
  const float of_b = largest_component(along_b);
  const float of_c = largest_component(along_c);
  const vec3 u = exact_times(along_b, inverse_power_of_two(of_b));
  const vec3 v = exact_times(along_c, inverse_power_of_two(of_c));
  EXACT float x = u.y * v.z - u.z * v.y;
  EXACT float y = u.z * v.x - u.x * v.z;
  EXACT float z = u.x * v.y - u.y * v.x;
  const float largest = largest_component(vec3(x, y, z));
  if (of_b == 0.0f || of_c == 0.0f || largest == 0.0f) return vec3(0.0f, 1.0f, 0.0f);
  const vec3 n = exact_times(vec3(x, y, z), inverse_power_of_two(largest));
  EXACT float squared = n.x * n.x + n.y * n.y + n.z * n.z;
  return exact_times(n, exact_inverse_root(squared));
}

// Returns the cosine and the sine of an angle that is even over the turn if the word is even over all words.
INLINE vec2 exact_turn(uint word) {
  // Within an eighth of a turn the series are exact to 5e-7.
  EXACT float angle = (unit_interval(word << 2u) - 0.5f) * 1.5707963267948966f;
  EXACT float square = angle * angle;
  EXACT float sine = angle * (1.0f - square * (1.6666667e-1f - square * (8.3333333e-3f - square * 1.9841270e-4f)));
  EXACT float cosine = 1.0f - square * (0.5f - square * (4.1666667e-2f - square * (1.3888889e-3f - square * 2.4801587e-5f)));
  const uint quarter = word >> 30u;
  if (quarter == 0u) return vec2(cosine, sine);
  if (quarter == 1u) return vec2(-sine, cosine);
  if (quarter == 2u) return vec2(-cosine, -sine);
  return vec2(sine, -cosine);
}

// Returns a direction of any length that is cosine-distributed about the unit normal if both words are even over all words: the
// normal plus a point that is even over the unit sphere. No frame turns with the leaf, so that an even sequence of words is
// even over the directions in space. Directions that rise less than 7e-4 above the surface, one in two million, become the
// normal, because rounding could send them to the other side.
INLINE vec3 cosine_direction(vec3 normal, uint u, uint v) {
  const float height = unit_interval(u);
  EXACT float z = 1.0f - 2.0f * height;
  EXACT float squared = 4.0f * (height * (1.0f - height));
  const float radius = exact_root(squared);
  const vec2 turn = exact_turn(v);
  EXACT float x = normal.x + radius * turn.x;
  EXACT float y = normal.y + radius * turn.y;
  EXACT float along_z = normal.z + z;
  EXACT float rise = x * normal.x + y * normal.y + along_z * normal.z;
  return rise < 9.5367431640625e-7f ? normal : vec3(x, y, along_z);
}

// Returns the barycentric weights of corners b and c of a point that is even over a triangle if both words are even over all
// words (Turk 1990, Graphics Gems).
INLINE vec2 even_weights(uint u, uint v) {
  const float root = exact_root(unit_interval(u));
  const float part = unit_interval(v);
  EXACT float weight_b = root * (1.0f - part);
  EXACT float weight_c = root * part;
  return vec2(weight_b, weight_c);
}

// Returns a point of a triangle. Rounding does not move it out of the triangle's box, where it could lie behind a wall that meets
// the triangle at an edge.
INLINE vec3 point_on_triangle(vec3 a, vec3 b, vec3 c, float weight_b, float weight_c) {
  EXACT vec3 at = a + (b - a) * vec3(weight_b) + (c - a) * vec3(weight_c);
  return vec3(held_among(at.x, a.x, b.x, c.x), held_among(at.y, a.y, b.y, c.y), held_among(at.z, a.z, b.z, c.z));
}

// A coordinate moved into the period 0 to `period`.
struct Wrapped {
  float at;
  float periods;  // by which it was moved down
};

// `per_period` is 1 / period.
INLINE Wrapped wrapped_into(float x, float period, float per_period) {
  EXACT float quotient = x * per_period;
  Wrapped wrapped;
  wrapped.periods = floor(quotient);
  EXACT float at = x - wrapped.periods * period;
  wrapped.at = at < 0.0f ? 0.0f : (at > period ? period : at);
  return wrapped;
}

// Steps of the additive sequence of directions, as parts of 2^32: the first two powers of 1 / 1.3247..., the plastic number.
// Places on a lamp take two other steps, because a sequence in four dimensions would have different ones in all of them.
const uint step_u = 0xc13fa9a9u;
const uint step_v = 0x91e10da6u;
const uint lamp_step_u = 0x9e3779b9u;
const uint lamp_step_v = 0x49d07e62u;

// Returns the direction of a packet; the words are random and the same for all packets of a round.
INLINE vec3 direction_of_packet(vec3 normal, uint number, uvec4 words) {
  return cosine_direction(normal, words.x + number * step_u, words.y + number * step_v);
}

// Returns the weights of corners b and c of the point on a lamp where a packet starts.
INLINE vec2 weights_on_lamp(uint number, uvec4 words) {
  return even_weights(words.z + number * lamp_step_u, words.w + number * lamp_step_v);
}

// Returns the normal of a side of a triangle, 0 or 1.
INLINE vec3 normal_of_side(vec3 a, vec3 b, vec3 c, uint side) {
  const float sign = side == 0u ? 1.0f : -1.0f;
  return exact_times(exact_normal(a, b, c), sign);
}

// A point of an endless plot, moved into the period that the tree covers, and the number of the element's copy there
// (BvhTriangle::image).
struct InPeriod {
  vec3 at;
  uint image;
};

// `per_period` is 1 / period.
INLINE InPeriod moved_into_period(vec3 point, vec2 period, vec2 per_period) {
  const Wrapped x = wrapped_into(point.x, period.x, per_period.x);
  const Wrapped z = wrapped_into(point.z, period.y, per_period.y);
  InPeriod moved;
  moved.at = vec3(x.at, point.y, z.at);
  moved.image = (uint(-int(x.periods)) & 0xffffu) | uint(-int(z.periods)) << 16u;
  return moved;
}

SHARED_END

#endif

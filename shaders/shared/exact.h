// Arithmetic that every device rounds alike.
#ifndef SUNFLECK_SHARED_EXACT_H
#define SUNFLECK_SHARED_EXACT_H

#include "shared/bridge.h"

SHARED_BEGIN

INLINE float magnitude(float x) {
  return uintBitsToFloat(floatBitsToUint(x) & 0x7fffffffu);
}

// Returns x, moved to between the smallest and the largest of three numbers.
INLINE float held_among(float x, float a, float b, float c) {
  const float least = a < b ? (a < c ? a : c) : (b < c ? b : c);
  const float largest = a > b ? (a > c ? a : c) : (b > c ? b : c);
  return x < least ? least : (x > largest ? largest : x);
}

// Returns origin + t direction.
INLINE vec3 point_along(vec3 origin, vec3 direction, float t) {
  EXACT vec3 at = origin + direction * vec3(t);
  return at;
}

// Returns 1 / x within two units in the last place, for 2^-100 < |x| < 2^100: an integer guess (error below 13 %) and four
// Newton steps y (2 - x y), each of which squares the error.
INLINE float exact_reciprocal(float x) {
  const uint sign = floatBitsToUint(x) & 0x80000000u;
  const float a = magnitude(x);
  float y = uintBitsToFloat(0x7ef311c3u - floatBitsToUint(a));
  for (uint step = 0u; step < 4u; ++step) {
    EXACT float product = a * y;
    EXACT float correction = 2.0f - product;
    EXACT float next = y * correction;
    y = next;
  }
  return uintBitsToFloat(floatBitsToUint(y) | sign);
}

// Returns 1 / x for a component of a direction; a component that is (nearly) zero counts as +-2^-60, so that products with
// lengths stay finite.
INLINE float direction_reciprocal(float x) {
  const uint sign = floatBitsToUint(x) & 0x80000000u;
  if (magnitude(x) < 8.673617379884035e-19f) return uintBitsToFloat(floatBitsToUint(1152921504606846976.0f) | sign);
  return exact_reciprocal(x);
}

// Returns 1 / sqrt(x) within three units in the last place, for 2^-100 < x < 2^100: an integer guess (error below 4 %; Lomont
// 2003, "Fast inverse square root") and four Newton steps y (3 - x y^2) / 2.
INLINE float exact_inverse_root(float x) {
  float y = uintBitsToFloat(0x5f375a86u - (floatBitsToUint(x) >> 1u));
  EXACT float half_x = 0.5f * x;
  for (uint step = 0u; step < 4u; ++step) {
    EXACT float square = y * y;
    EXACT float product = half_x * square;
    EXACT float correction = 1.5f - product;
    EXACT float next = y * correction;
    y = next;
  }
  return y;
}

// Returns sqrt(x) as precisely, and 0 for 0.
INLINE float exact_root(float x) {
  if (x <= 0.0f) return 0.0f;
  EXACT float root = x * exact_inverse_root(x);
  return root;
}

SHARED_END

#endif

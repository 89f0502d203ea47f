// Counter-based random numbers: a value is a function of (key, ray number, dimension) and of nothing else.
#ifndef SUNFLECK_SHARED_RANDOM_H
#define SUNFLECK_SHARED_RANDOM_H

#include "shared/bridge.h"

SHARED_BEGIN

// Returns four random words: pcg4d of Jarzynski & Olano 2020, "Hash functions for GPU rendering", JCGT 9(3), listing 4.
INLINE uvec4 random_words(uvec2 key, uint ray, uint dimension) {
  uint x = ray * 1664525u + 1013904223u;
  uint y = dimension * 1664525u + 1013904223u;
  uint z = key.x * 1664525u + 1013904223u;
  uint w = key.y * 1664525u + 1013904223u;
  for (uint round = 0u; round < 2u; ++round) {
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    if (round == 0u) {
      x ^= x >> 16u;
      y ^= y >> 16u;
      z ^= z >> 16u;
      w ^= w >> 16u;
    }
  }
  return uvec4(x, y, z, w);
}

// Returns a number in [0, 1), never 1, with 24 random bits.
INLINE float unit_interval(uint word) {
  EXACT float unit = float(word >> 8u) * (1.0f / 16777216.0f);
  return unit;
}

SHARED_END

#endif

// Calls every function of shaders/shared/quanta.h and aim.h, and is shared text itself. A 64-bit number is two words, the low one
// first.
#ifndef SUNFLECK_TESTS_QUANTA_TEXT_H
#define SUNFLECK_TESTS_QUANTA_TEXT_H

#include "shared/aim.h"
#include "shared/layout.h"
#include "shared/quanta.h"

SHARED_BEGIN

struct QuantaInput {
  uvec2 any_a;
  uvec2 any_b;
  uvec2 offset;
  uvec2 rest;  // below the divisor
  uvec2 divisor;
  uvec2 coefficient;
  uvec2 parts_each;
  uvec2 denominator;
  uvec2 scaled_quanta;
  Scale scale;
  uvec2 expectation;
  uvec2 expected;
  uvec2 weights;
  uint spare_bits;
  uint number;
  uint word;
  StandSphere stand;
  vec3 point;
};

struct QuantaOutput {
  uvec2 high;
  uvec2 quotient;
  uvec2 part;
  uvec2 at_point;
  uint place;
  Scale scale;
  uvec2 scaled_quanta;
  uvec2 drawn;
  Sharing sharing;
  uint share;
  uvec2 load_factor;
  uint load_shift;
  uvec2 carried_quanta;
  uvec2 aimed;
};

struct QuantaPush {
  uint count;
};

INLINE uint64_t joined(uvec2 words) {
  return uint64_t(words.y) << 32u | uint64_t(words.x);
}

INLINE uvec2 apart(uint64_t number) {
  return uvec2(uint(number & uint64_t(low_word)), uint(number >> 32u));
}

INLINE QuantaOutput all_of_the_quanta(QuantaInput given) {
  const uint64_t a = joined(given.any_a);
  const uint64_t b = joined(given.any_b);
  QuantaOutput result;
  result.high = apart(product_high(a, b));
  result.quotient = apart(long_quotient(joined(given.rest), a, joined(given.divisor)));
  result.part = apart(part_of(a, joined(given.coefficient), given.word));
  result.at_point = apart(quanta_at_point(a, joined(given.divisor)));
  result.place = place_part(given.number, joined(given.parts_each));
  result.scale = scale_of(a, joined(given.denominator));
  result.scaled_quanta = apart(scaled(joined(given.scaled_quanta), given.scale));
  result.drawn = apart(drawn_up_to(a, b, joined(given.offset)));
  result.sharing = sharing_of(joined(given.expectation), given.spare_bits);
  result.share = share_of(joined(given.expected), result.sharing);
  const Load load = load_of(a, joined(given.weights));
  result.load_factor = apart(load.factor);
  result.load_shift = load.shift;
  result.carried_quanta = apart(carried(given.word, load));
  result.aimed = apart(aimed_part(given.stand, given.point));
  return result;
}

SHARED_END

#endif

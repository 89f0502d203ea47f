// The arithmetic of quanta: how they split where they land, how many packets are drawn, and what each of them carries. It is
// exact in 64-bit integers, so that every device gives the same bits. GLSL needs GL_EXT_shader_explicit_arithmetic_types_int64.
//
// A coefficient is a part of 2^32, up to 2^32 itself. Numbers of packets are in units of 2^-32 until they are drawn.
#ifndef SUNFLECK_SHARED_QUANTA_H
#define SUNFLECK_SHARED_QUANTA_H

#include "shared/bridge.h"

SHARED_BEGIN

const uint low_word = 0xffffffffu;

// Returns floor(a b / 2^64).
INLINE uint64_t product_high(uint64_t a, uint64_t b) {
  const uint64_t a_low = a & uint64_t(low_word);
  const uint64_t a_high = a >> 32u;
  const uint64_t b_low = b & uint64_t(low_word);
  const uint64_t b_high = b >> 32u;
  const uint64_t middle = a_high * b_low + (a_low * b_low >> 32u);
  const uint64_t other = a_low * b_high + (middle & uint64_t(low_word));
  return a_high * b_high + (middle >> 32u) + (other >> 32u);
}

// Returns floor((high 2^64 + low) / divisor) for high < divisor <= 2^63, bit by bit.
INLINE uint64_t long_quotient(uint64_t high, uint64_t low, uint64_t divisor) {
  uint64_t rest = high;
  uint64_t result = uint64_t(0u);
  for (uint bit = 0u; bit < 64u; ++bit) {
    rest = (rest << 1u) | ((low >> (63u - bit)) & uint64_t(1u));
    result = result << 1u;
    if (rest >= divisor) {
      rest -= divisor;
      result |= uint64_t(1u);
    }
  }
  return result;
}

// Returns the part of some quanta that a coefficient describes, rounded down or up at random so that its expectation is right;
// u has 32 random bits. All parts with the same u are in the order of their coefficients, 0 gives 0 and 2^32 gives all quanta,
// so that what is reflected, transmitted and absorbed are differences of parts and add up to the quanta. Nothing overflows:
// (2^32 - 1) 2^32 + 2^32 - 1 = 2^64 - 1.
INLINE uint64_t part_of(uint64_t quanta, uint64_t coefficient, uint u) {
  return (quanta >> 32u) * coefficient + (((quanta & uint64_t(low_word)) * coefficient + uint64_t(u)) >> 32u);
}

const uint64_t most_at_point = uint64_t(1u) << 52u;

// Returns what landed at each of several points that send `sent` quanta together, if the coefficients of what they scatter add
// up to `coefficients`, which is at most 2^63: the nearest number of quanta, at most most_at_point. 0 if the points scatter
// nothing.
INLINE uint64_t quanta_at_point(uint64_t sent, uint64_t coefficients) {
  if (coefficients == uint64_t(0u)) return uint64_t(0u);
  const uint64_t low = (sent << 32u) + (coefficients >> 1u);
  const uint64_t high = (sent >> 32u) + (low < (coefficients >> 1u) ? uint64_t(1u) : uint64_t(0u));
  if (high >= coefficients) return most_at_point;
  const uint64_t quanta = long_quotient(high, low, coefficients);
  return quanta < most_at_point ? quanta : most_at_point;
}

// Places are drawn from in 256 parts: neighbours in the tree's leaf order, then on the ground.
const uint element_parts = 240u;
const uint ground_parts = 16u;

// Returns the part of the number-th place; `parts_each` is 2^32 times the number of parts divided by that of numbers, rounded
// down.
INLINE uint place_part(uint number, uint64_t parts_each) {
  return uint(uint64_t(number) * parts_each >> 32u);
}

// A factor: mantissa / 2^shift, with a shift of at most 32.
struct Scale {
  uint mantissa;
  uint shift;
};

// Returns the largest scale up to numerator / denominator, which is at most 2^63; the largest of all, 2^32 - 1, if that is not
// enough.
INLINE Scale scale_of(uint64_t numerator, uint64_t denominator) {
  Scale scale;
  scale.mantissa = low_word;
  scale.shift = 0u;
  if ((numerator >> 32u) >= denominator) return scale;
  uint64_t ratio = long_quotient(numerator >> 32u, numerator << 32u, denominator);
  uint shift = 32u;
  while (ratio > uint64_t(low_word)) {
    ratio = ratio >> 1u;
    --shift;
  }
  scale.mantissa = uint(ratio);
  scale.shift = shift;
  return scale;
}

// Returns floor(quanta mantissa / 2^shift), which must be less than 2^64.
INLINE uint64_t scaled(uint64_t quanta, Scale by) {
  const uint64_t mantissa = uint64_t(by.mantissa);
  return ((quanta >> 32u) * mantissa << (32u - by.shift)) + ((quanta & uint64_t(low_word)) * mantissa >> by.shift);
}

// Returns how many packets are drawn from all places up to one, with the sum of their expectations, of which `gain` / 2^32
// packets are drawn: systematic sampling with one random offset for all places (Madow & Madow 1944, Ann. Math. Stat. 15:1).
INLINE uint64_t drawn_up_to(uint64_t sum, uint64_t gain, uint64_t offset) {
  const uint64_t low = sum * gain;
  return product_high(sum, gain) + (low + offset < low ? uint64_t(1u) : uint64_t(0u));
}

// How a packet divides its place's expectation among its columns.
struct Sharing {
  uint inverse;     // 2^63 divided by the expectation's leading 32 bits
  int shift_right;  // to the leading bits; to the left if negative
};

// `expectation` is not 0 and below 2^63. The parts of a place that draws fewer packets than its flux stands for may reach, but
// not exceed, (expectation + 1) 2^spare_bits.
INLINE Sharing sharing_of(uint64_t expectation, uint spare_bits) {
  const uint high = uint(expectation >> 32u);
  const int leading = high != 0u ? 32 + findMSB(high) : findMSB(uint(expectation & uint64_t(low_word)));
  const uint64_t bits = leading >= 31 ? expectation >> uint(leading - 31) : expectation << uint(31 - leading);
  Sharing sharing;
  sharing.inverse = uint(uint64_t(0x7fffffffffffffffl) / bits);
  sharing.shift_right = leading - 31 + int(spare_bits);
  return sharing;
}

// Returns what share_of adds before it drops the low bits, so that it rounds to the nearest.
INLINE uint64_t half_of(Sharing sharing) {
  return sharing.shift_right > 0 ? uint64_t(1u) << uint(sharing.shift_right - 1) : uint64_t(0u);
}

// Returns the weight of a column in a packet, in units of 2^(spare_bits - 31) of a packet, within two of them: at most 2^31
// without spare bits, and below 2^32 with them. `expected` is the column's own part of the expectation.
INLINE uint share_of(uint64_t expected, Sharing sharing) {
  const uint64_t rounded = expected + half_of(sharing);
  const uint64_t bits = sharing.shift_right >= 0 ? rounded >> uint(sharing.shift_right) : rounded << uint(-sharing.shift_right);
  const uint64_t held = bits < uint64_t(low_word) ? bits : uint64_t(low_word);
  return uint((held * uint64_t(sharing.inverse) + (uint64_t(1u) << 31u)) >> 32u);
}

// What one unit of weight carries of a column: factor / 2^shift quanta, with a shift of 32 to 47.
struct Load {
  uint64_t factor;  // 0 if no packet carries the column
  uint shift;
};

// Returns the largest load of which `weights` units are not more than the column's total; both are below 2^63. No packet
// carries a column whose weights come to less than 2^-32 of its quanta.
INLINE Load load_of(uint64_t total, uint64_t weights) {
  Load load;
  load.factor = uint64_t(0u);
  load.shift = 47u;
  while (load.shift > 32u && total >> (64u - load.shift) >= weights) --load.shift;
  const uint64_t high = total >> (64u - load.shift);
  if (high < weights) load.factor = long_quotient(high, total << load.shift, weights);
  return load;
}

// Returns the quanta that a packet carries. They add up to the total but for what rounding leaves: hardly more than one quantum
// a packet at the usual shifts, and less than two, which wait for the next round.
INLINE uint64_t carried(uint weight, Load load) {
  const uint64_t low = uint64_t(weight) * (load.factor & uint64_t(low_word)) >> 32u;
  return (uint64_t(weight) * (load.factor >> 32u) + low) >> (load.shift - 32u);
}

SHARED_END

#endif

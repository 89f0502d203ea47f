// Tests the arithmetic of quanta against integers of 128 bits.

#include "shared/quanta.h"

#include "support/wide_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace sunfleck::shared {
namespace {

using test::all_ones;
using test::some_number;
using test::some_number_up_to;
using test::two_to_32;
using test::two_to_63;
using test::Wide;

constexpr int tries = 100'000;

uint64_t low_half(Wide number) {
  return static_cast<uint64_t>(number);
}

uint64_t high_half(Wide number) {
  return static_cast<uint64_t>(number >> 64U);
}

uint64_t at_least_one(uint64_t number) {
  return std::max<uint64_t>(1, number);
}

TEST(ProductHigh, IsTheUpperHalfOfTheProduct) {
  std::mt19937_64 random(1);
  for (int k = 0; k < tries; ++k) {
    const uint64_t a = some_number(random);
    const uint64_t b = some_number(random);
    ASSERT_EQ(product_high(a, b), high_half(Wide{a} * b)) << a << " * " << b;
  }
  EXPECT_EQ(product_high(all_ones, all_ones), all_ones - 1);
}

TEST(LongQuotient, IsThatOfAHundredAndTwentyEightBits) {
  std::mt19937_64 random(2);
  for (int k = 0; k < tries / 4; ++k) {
    const uint64_t divisor = at_least_one(some_number_up_to(random, two_to_63));
    const uint64_t high = some_number_up_to(random, divisor - 1);
    const uint64_t low = some_number(random);
    const Wide dividend = (Wide{high} << 64U) + low;
    ASSERT_EQ(long_quotient(high, low, divisor), low_half(dividend / divisor)) << high << ' ' << low << ' ' << divisor;
  }
  EXPECT_EQ(long_quotient(two_to_63 - 1, all_ones, two_to_63), all_ones);
}

TEST(PartOf, IsNothingOrAllAtTheEndsOfTheCoefficient) {
  std::mt19937_64 random(3);
  for (int k = 0; k < tries; ++k) {
    const uint64_t quanta = some_number(random);
    const uint u = test::some_word(random);
    ASSERT_EQ(part_of(quanta, 0, u), 0U) << quanta << ' ' << u;
    ASSERT_EQ(part_of(quanta, two_to_32, u), quanta) << u;
  }
}

// A part is rounded up by as many of the 2^32 values of u as its fraction has units of 2^-32.
TEST(PartOf, HasTheRightExpectation) {
  std::mt19937_64 random(4);
  for (int k = 0; k < tries; ++k) {
    const uint64_t quanta = some_number(random);
    const uint64_t coefficient = some_number_up_to(random, two_to_32);
    const Wide exact = Wide{quanta} * coefficient;
    const uint64_t down = low_half(exact >> 32U);
    const uint64_t fraction = low_half(exact) % two_to_32;
    ASSERT_EQ(part_of(quanta, coefficient, 0), down) << quanta << ' ' << coefficient;
    const auto last_down = static_cast<uint>(two_to_32 - 1 - fraction);
    ASSERT_EQ(part_of(quanta, coefficient, last_down), down) << quanta << ' ' << coefficient;
    if (fraction == 0) continue;
    ASSERT_EQ(part_of(quanta, coefficient, last_down + 1), down + 1) << quanta << ' ' << coefficient;
    ASSERT_EQ(part_of(quanta, coefficient, low_word), down + 1) << quanta << ' ' << coefficient;
  }
}

TEST(PartOf, GrowsWithTheCoefficient) {
  std::mt19937_64 random(5);
  for (int k = 0; k < tries; ++k) {
    const uint64_t quanta = some_number(random);
    const uint u = test::some_word(random);
    const uint64_t coefficient = some_number_up_to(random, two_to_32 - 1);
    const uint64_t larger = coefficient + 1 + some_number_up_to(random, two_to_32 - 1 - coefficient);
    const uint64_t part = part_of(quanta, coefficient, u);
    ASSERT_LE(part, part_of(quanta, coefficient + 1, u)) << quanta << ' ' << coefficient << ' ' << u;
    ASSERT_LE(part, part_of(quanta, larger, u)) << quanta << ' ' << coefficient << ' ' << larger << ' ' << u;
  }
}

TEST(PlacePart, DividesThePlacesEvenly) {
  for (const uint places : {1U, 2U, 239U, 240U, 241U, 1000U, 12'345U}) {
    const uint64_t parts_each = two_to_32 * element_parts / places;
    std::array<int, element_parts> in_part{};
    uint last = 0;
    for (uint number = 0; number < places; ++number) {
      const uint part = place_part(number, parts_each);
      ASSERT_LT(part, element_parts) << number << " of " << places;
      ASSERT_GE(part, last) << number << " of " << places;
      ++in_part[part];
      last = part;
    }
    const int even = static_cast<int>(places / element_parts);
    for (const int count : in_part) {
      EXPECT_GE(count, even - 1) << places;
      EXPECT_LE(count, even + 2) << places;
    }
  }
}

TEST(PlacePart, ReachesTheLastPartAndNoFurther) {
  for (const uint places : {1U << 20U, 1U << 31U, 0xfffffffeU, 0xffffffffU}) {
    const uint64_t parts_each = two_to_32 * ground_parts / places;
    EXPECT_EQ(place_part(0, parts_each), 0U);
    EXPECT_EQ(place_part(places / 2 + ground_parts, parts_each), ground_parts / 2) << places;
    EXPECT_EQ(place_part(places - 1, parts_each), ground_parts - 1) << places;
  }
}

// Returns 2^32 times the largest scale up to a quotient, by a search among all shifts.
uint64_t largest_scale(uint64_t numerator, uint64_t denominator) {
  uint64_t largest = 0;
  for (uint shift = 0; shift <= 32; ++shift) {
    const Wide most = denominator == 0 ? Wide{low_word} : (Wide{numerator} << shift) / denominator;
    largest = std::max(largest, low_half(std::min<Wide>(most, low_word)) << (32U - shift));
  }
  return largest;
}

TEST(ScaleOf, IsTheLargestPossible) {
  std::mt19937_64 random(6);
  int fractions = 0;
  int wholes = 0;
  for (int k = 0; k < tries / 4; ++k) {
    const uint64_t numerator = some_number(random);
    const uint64_t denominator = some_number_up_to(random, two_to_63);
    const Scale scale = scale_of(numerator, denominator);
    ASSERT_LE(scale.shift, 32U);
    ASSERT_EQ(uint64_t{scale.mantissa} << (32U - scale.shift), largest_scale(numerator, denominator))
        << numerator << " / " << denominator;
    fractions += scale.mantissa != 0 && scale.shift == 32 ? 1 : 0;
    wholes += scale.mantissa != low_word && scale.shift < 32 ? 1 : 0;
  }
  EXPECT_GT(fractions, tries / 40);
  EXPECT_GT(wholes, tries / 40);
}

TEST(Scaled, IsRoundedDown) {
  std::mt19937_64 random(7);
  for (int k = 0; k < tries; ++k) {
    const Scale scale = {test::some_word(random), static_cast<uint>(random() % 33U)};
    const Wide end = (Wide{1} << (64U + scale.shift)) - 1;
    const Wide largest = scale.mantissa == 0 ? Wide{all_ones} : std::min<Wide>(end / scale.mantissa, all_ones);
    const uint64_t quanta = some_number_up_to(random, low_half(largest));
    ASSERT_EQ(scaled(quanta, scale), low_half(Wide{quanta} * scale.mantissa >> scale.shift))
        << quanta << ' ' << scale.mantissa << ' ' << scale.shift;
  }
}

// One more packet is drawn for as many of the 2^64 offsets as the expectation's fraction has units of 2^-64.
TEST(DrawnUpTo, HasTheRightExpectation) {
  std::mt19937_64 random(8);
  for (int k = 0; k < tries; ++k) {
    const uint64_t sum = some_number(random);
    const uint64_t gain = some_number(random);
    const Wide exact = Wide{sum} * gain;
    const uint64_t fraction = low_half(exact);
    ASSERT_EQ(drawn_up_to(sum, gain, 0), high_half(exact)) << sum << ' ' << gain;
    ASSERT_EQ(drawn_up_to(sum, gain, all_ones - fraction), high_half(exact)) << sum << ' ' << gain;
    if (fraction == 0) continue;
    ASSERT_EQ(drawn_up_to(sum, gain, all_ones - fraction + 1), high_half(exact) + 1) << sum << ' ' << gain;
    ASSERT_EQ(drawn_up_to(sum, gain, all_ones), high_half(exact) + 1) << sum << ' ' << gain;
  }
}

TEST(DrawnUpTo, DrawsFromEachPlaceWhatIsExpectedOfIt) {
  std::mt19937_64 random(9);
  for (int k = 0; k < 100; ++k) {
    const uint64_t offset = some_number(random);
    uint64_t sum = 0;
    uint64_t drawn = 0;
    for (int place = 0; place < 200; ++place) {
      const uint64_t expectation = random() >> (28U + random() % 20);  // up to 16 packets
      sum += expectation;
      const uint64_t up_to = drawn_up_to(sum, two_to_32, offset);
      ASSERT_GE(up_to - drawn, expectation / two_to_32);
      ASSERT_LE(up_to - drawn, expectation / two_to_32 + 1);
      drawn = up_to;
    }
  }
}

struct Shares {
  uint64_t expectation;
  uint64_t expected;
  uint spare_bits;
};

Shares some_shares(std::mt19937_64& random) {
  Shares shares;
  shares.expectation = at_least_one(some_number(random) >> 1U);
  shares.spare_bits = random() % 2 == 0 ? 0 : static_cast<uint>(random() % 11U);
  const Wide most = std::min<Wide>(Wide{shares.expectation} << shares.spare_bits, all_ones >> 1U);
  shares.expected = some_number_up_to(random, low_half(most));
  return shares;
}

// The expectation's leading bits, their inverse and the column's part lose at most a unit each.
TEST(ShareOf, IsThePartOfTheExpectation) {
  std::mt19937_64 random(10);
  int large = 0;
  for (int k = 0; k < tries; ++k) {
    const Shares shares = some_shares(random);
    const uint share = share_of(shares.expected, sharing_of(shares.expectation, shares.spare_bits));
    ASSERT_LE(share, (1U << 31U) + 1U) << shares.expected << " of " << shares.expectation << ", " << shares.spare_bits;
    const auto exact = std::ldexp(static_cast<long double>(shares.expected) / static_cast<long double>(shares.expectation),
                                  31 - static_cast<int>(shares.spare_bits));
    ASSERT_NEAR(static_cast<double>(share), static_cast<double>(exact), 3.0)
        << shares.expected << " of " << shares.expectation << ", " << shares.spare_bits;
    large += share > 1U << 20U ? 1 : 0;
  }
  EXPECT_GT(large, tries / 10);
}

TEST(ShareOf, HasTheSamePrecisionForEveryExpectation) {
  for (uint bit = 0; bit < 63; ++bit) {
    for (const uint64_t expectation : {uint64_t{1} << bit, all_ones >> (63U - bit)}) {
      EXPECT_GE(share_of(expectation, sharing_of(expectation, 0)), (1U << 31U) - 3) << expectation;
      EXPECT_NEAR(share_of(expectation, sharing_of(expectation, 10)), 1U << 21U, 3.0) << expectation;
      EXPECT_EQ(share_of(0, sharing_of(expectation, 0)), 0U) << expectation;
    }
  }
}

TEST(LoadOf, IsTheLargestPossible) {
  std::mt19937_64 random(11);
  int loaded = 0;
  for (int k = 0; k < tries / 4; ++k) {
    const uint64_t total = some_number_up_to(random, two_to_63 - 1);
    const uint64_t weights = some_number_up_to(random, two_to_63);
    const Load load = load_of(total, weights);
    ASSERT_GE(load.shift, 32U);
    ASSERT_LE(load.shift, 47U);
    if (total >> 32U >= weights) {
      ASSERT_EQ(load.factor, 0U) << total << " / " << weights;
      continue;
    }
    ASSERT_EQ(load.factor, low_half((Wide{total} << load.shift) / weights)) << total << " / " << weights;
    ASSERT_EQ(high_half((Wide{total} << load.shift) / weights), 0U) << total << " / " << weights;
    if (load.shift < 47) {
      ASSERT_NE(high_half((Wide{total} << (load.shift + 1)) / weights), 0U);
    }
    ++loaded;
  }
  EXPECT_GT(loaded, tries / 10);
}

TEST(LoadOf, IsNothingIfTheWeightsAreTooSmall) {
  EXPECT_EQ(load_of(0, 0).factor, 0U);
  EXPECT_EQ(load_of(1, 0).factor, 0U);
  EXPECT_EQ(load_of(two_to_63 - 1, 0).factor, 0U);
  EXPECT_EQ(load_of(two_to_63 - 1, (two_to_63 - 1) >> 32U).factor, 0U);
  EXPECT_GT(load_of(two_to_63 - 1, two_to_63 >> 32U).factor, all_ones / 2);
  EXPECT_EQ(load_of(two_to_32, 1).factor, 0U);
  EXPECT_EQ(load_of(two_to_32 - 1, 1).factor, (two_to_32 - 1) << 32U);
}

TEST(Carried, IsRoundedDown) {
  std::mt19937_64 random(12);
  for (int k = 0; k < tries; ++k) {
    const uint weight = test::some_word(random);
    const Load load = {some_number(random), 32U + static_cast<uint>(random() % 16U)};
    ASSERT_EQ(carried(weight, load), low_half(Wide{load.factor} * weight >> load.shift))
        << weight << ' ' << load.factor << ' ' << load.shift;
  }
}

// Packets of very different weights take along a column's total, but for at most a quantum each.
TEST(Carried, AddsUpToTheTotal) {
  std::mt19937_64 random(13);
  int nothing = 0;
  for (int k = 0; k < 2'000; ++k) {
    std::vector<uint> weight(1 + random() % 100);
    const uint64_t magnitude = random() % 31;
    uint64_t weights = 0;
    for (uint& w : weight) {
      w = static_cast<uint>(random() >> (33U + (random() % 4 == 0 ? random() % 31 : magnitude)));
      weights += w;
    }
    const uint64_t total = some_number_up_to(random, two_to_63 - 1);
    const Load load = load_of(total, weights);
    uint64_t sum = 0;
    uint64_t packets = 0;
    for (const uint w : weight) {
      const uint64_t quanta = carried(w, load);
      sum += quanta;
      packets += w != 0 ? 1 : 0;
      if (load.factor == 0) continue;
      const uint64_t even = low_half(Wide{total} * w / weights);
      ASSERT_LE(quanta, even);
      ASSERT_LE(even - quanta, 1U);
    }
    nothing += load.factor == 0 ? 1 : 0;
    ASSERT_LE(sum, total) << weights;
    if (load.factor == 0) {
      ASSERT_EQ(sum, 0U);
    } else {
      ASSERT_LE(total - sum, packets) << total << ' ' << weights;
    }
  }
  EXPECT_LT(nothing, 1'000);
}

TEST(QuantaAtPoint, AreTheNearestNumber) {
  std::mt19937_64 random(8);
  std::size_t cut_off = 0;
  for (int k = 0; k < tries; ++k) {
    const uint64_t sent = some_number(random);
    const uint64_t coefficients = at_least_one(some_number_up_to(random, two_to_63));
    const Wide nearest = ((Wide{sent} << 32U) + coefficients / 2) / coefficients;
    cut_off += nearest > most_at_point ? 1 : 0;
    ASSERT_EQ(quanta_at_point(sent, coefficients), low_half(std::min<Wide>(nearest, most_at_point)))
        << sent << ' ' << coefficients;
  }
  EXPECT_GT(cut_off, 1000U);
  EXPECT_EQ(quanta_at_point(1000, 0), 0U) << "points that scatter nothing";
}

}  // namespace
}  // namespace sunfleck::shared

#include "shared/random.h"

#include "support/chi_square.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace sunfleck::shared {
namespace {

// Repeats the paper's listing in whole numbers modulo 2^32.
std::array<std::uint64_t, 4> pcg4d(std::array<std::uint64_t, 4> v) {
  constexpr std::uint64_t modulus = std::uint64_t{1} << 32U;
  const auto mix = [&v] {
    v[0] = (v[0] + v[1] * v[3]) % modulus;
    v[1] = (v[1] + v[2] * v[0]) % modulus;
    v[2] = (v[2] + v[0] * v[1]) % modulus;
    v[3] = (v[3] + v[1] * v[2]) % modulus;
  };
  for (std::uint64_t& word : v) word = (word * 1664525U + 1013904223U) % modulus;
  mix();
  for (std::uint64_t& word : v) word ^= word / 65536U;
  mix();
  return v;
}

TEST(RandomWords, AreThoseOfThePaper) {
  EXPECT_EQ(random_words({0, 0}, 0, 0), uvec4(0x0f02f829U, 0x2d568769U, 0x32b0c43bU, 0xd32548eaU));
  EXPECT_EQ(random_words({3, 4}, 1, 2), uvec4(0x3622cd16U, 0xf11471d8U, 0xe1109b3fU, 0x02b94c2fU));
  EXPECT_EQ(random_words({0xdeadbeefU, 0x12345678U}, 0xffffffffU, 0),
            uvec4(0x7b074236U, 0x7d2addefU, 0x896898aeU, 0x2088fdfeU));
  for (uint ray = 0; ray < 10'000; ++ray) {
    const uvec2 key(ray * 2654435761U, ray ^ 0x55555555U);
    const auto expected = pcg4d({ray, ray % 5, key.x, key.y});
    EXPECT_EQ(random_words(key, ray, ray % 5), uvec4(expected[0], expected[1], expected[2], expected[3]));
  }
}

TEST(UnitInterval, ReachesZeroAndNeverOne) {
  EXPECT_EQ(unit_interval(0), 0.0F);
  EXPECT_EQ(unit_interval(0xffU), 0.0F);
  EXPECT_EQ(unit_interval(0x80000000U), 0.5F);
  EXPECT_EQ(unit_interval(0xffffffffU), 1.0F - 0x1p-24F);
}

// Draws rays of one replicate, the same ray of many replicates, and the same ray in many dimensions.
TEST(RandomWords, AreSpreadEvenly) {
  constexpr uint count = 1U << 20U;
  const auto words = [](int way, uint k) {
    if (way == 0) return random_words({17, 4}, k, 0);
    return way == 1 ? random_words({17, k}, 4, 0) : random_words({17, 4}, 4, k);
  };
  for (int way = 0; way < 3; ++way) {
    std::vector<std::uint64_t> first(1024), second(1024), both(64 * 64);
    for (uint k = 0; k < count; ++k) {
      const uvec4 word = words(way, k);
      const auto u = static_cast<double>(unit_interval(word.x));
      const auto v = static_cast<double>(unit_interval(word.y));
      ++first[static_cast<std::size_t>(u * 1024.0)];
      ++second[static_cast<std::size_t>(v * 1024.0)];
      ++both[static_cast<std::size_t>(u * 64.0) * 64 + static_cast<std::size_t>(v * 64.0)];
    }
    test::expect_flat(first, "first dimension");
    test::expect_flat(second, "second dimension");
    test::expect_flat(both, "both together");
  }
}

// Neighbouring rays are independent: the standard error of a correlation of n pairs is 1 / sqrt(n).
TEST(RandomWords, OfNeighboursAreUncorrelated) {
  constexpr uint count = 1U << 20U;
  double sum = 0.0;
  for (uint ray = 0; ray < count; ++ray) {
    const auto here = static_cast<double>(unit_interval(random_words({1, 2}, ray, 0).x)) - 0.5;
    const auto next = static_cast<double>(unit_interval(random_words({1, 2}, ray + 1, 0).x)) - 0.5;
    sum += here * next;
  }
  EXPECT_LE(std::abs(sum / count * 12.0), 4.0 / std::sqrt(static_cast<double>(count)));
}

}  // namespace
}  // namespace sunfleck::shared

#pragma once
// Integers of 128 bits, against which the arithmetic of quanta is checked, and random integers of every magnitude.

#include <array>
#include <cstdint>
#include <random>

namespace sunfleck::test {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t all_ones = ~std::uint64_t{0};
constexpr std::uint64_t two_to_32 = std::uint64_t{1} << 32U;
constexpr std::uint64_t two_to_63 = std::uint64_t{1} << 63U;

// Returns a number with any number of bits; one in eight is 0, 1, a power of two that borders on a word, or next to one.
inline std::uint64_t some_number(std::mt19937_64& random) {
  constexpr std::array<std::uint64_t, 12> edges = {0,
                                                   1,
                                                   2,
                                                   two_to_32 / 2,
                                                   two_to_32 - 1,
                                                   two_to_32,
                                                   two_to_32 + 1,
                                                   all_ones << 32U,
                                                   two_to_63 - 1,
                                                   two_to_63,
                                                   all_ones - 1,
                                                   all_ones};
  const std::uint64_t kind = random();
  if (kind % 8 == 0) return edges[(kind >> 3U) % edges.size()];
  return random() >> (kind >> 3U) % 64;
}

// Returns such a number up to a limit, often the limit itself.
inline std::uint64_t some_number_up_to(std::mt19937_64& random, std::uint64_t limit) {
  const std::uint64_t number = some_number(random);
  if (number <= limit) return number;
  return random() % 4 == 0 ? limit : number % (limit + 1);
}

// Returns the random word that shared text draws on, often one of its ends.
inline std::uint32_t some_word(std::mt19937_64& random) {
  return static_cast<std::uint32_t>(random() % 2 == 0 ? random() : some_number_up_to(random, two_to_32 - 1));
}

}  // namespace sunfleck::test

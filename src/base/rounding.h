#pragma once
// Whole numbers rounded up to multiples.

#include <concepts>
#include <type_traits>

namespace sunfleck {

// Returns how many blocks of a size hold `count`.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T block_count(T count, std::type_identity_t<T> block_size) {
  return (count + block_size - 1) / block_size;
}

// Returns the smallest multiple of `step` that is not below x.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T rounded_up(T x, std::type_identity_t<T> step) {
  return block_count(x, step) * step;
}

}  // namespace sunfleck

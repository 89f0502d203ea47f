#pragma once
// Hides the wait for memory that is read in no order.

#include <cstddef>
#include <span>

namespace sunfleck {

// How many steps ahead a loop over places in no order asks for memory.
inline constexpr std::size_t prefetch_ahead = 12;

// Asks for the memory of a value that will soon be read or written; has no other effect.
template <class T>
void prefetch(const T& value) {
  const char* const bytes = reinterpret_cast<const char*>(&value);
  __builtin_prefetch(bytes);
  __builtin_prefetch(bytes + sizeof(T) - 1);
}

// Asks for the memory of a whole row of values.
template <class T>
void prefetch_row(std::span<const T> values) {
  constexpr std::size_t line_bytes = 64;
  const auto bytes = std::as_bytes(values);
  for (std::size_t k = 0; k < bytes.size(); k += line_bytes) __builtin_prefetch(&bytes[k]);
  if (!bytes.empty()) __builtin_prefetch(&bytes.back());
}

}  // namespace sunfleck

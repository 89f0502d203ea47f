#pragma once
// Appends numbers to the bytes of a file.

#include <bit>
#include <span>
#include <string>
#include <type_traits>

namespace sunfleck {

static_assert(std::endian::native == std::endian::little, "append_bytes copies numbers as stored in memory");

// Append the bytes of values for formats with little-endian numbers.
template <class T>
void append_bytes(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append_bytes(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace sunfleck

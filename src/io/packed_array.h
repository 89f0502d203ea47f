#pragma once
// Long arrays of numbers as CBOR byte strings: little-endian and deflated (zlib). And CBOR read that anyone may have written.

#include "base/error.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sunfleck {

static_assert(std::endian::native == std::endian::little);

// Throws std::runtime_error for bytes that are no CBOR, or lists and maps more than `deepest` within each other: the library's
// parser goes by recursion as deep as a file has it.
[[nodiscard]] nlohmann::json read_cbor(std::string_view bytes, std::size_t deepest);

// Throws std::runtime_error for what is no whole number, or none that T holds.
template <class T>
[[nodiscard]] T whole(const nlohmann::json& value) {
  const auto checked = [](auto number) {
    if (std::in_range<T>(number)) return static_cast<T>(number);
    throw std::runtime_error("a whole number is out of range");
  };
  if (value.is_number_unsigned()) return checked(value.get<std::uint64_t>());
  if (value.is_number_integer()) return checked(value.get<std::int64_t>());
  throw std::runtime_error("what should be a whole number is none");
}

[[nodiscard]] nlohmann::json::binary_t deflated(std::span<const std::byte> bytes);

// Fills `bytes`. False if the packed bytes are damaged or hold another number of bytes.
[[nodiscard]] bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes);

// False if so few packed bytes cannot hold so many: deflate makes 1032 bytes of one at most (zlib's technical details).
[[nodiscard]] bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size);

template <class T>
[[nodiscard]] nlohmann::json pack(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return nlohmann::json::binary(deflated(std::as_bytes(std::span(values))));
}

// `count` values. Throws std::runtime_error if that is not what was packed.
template <class T>
[[nodiscard]] std::vector<T> unpack(const nlohmann::json& json, std::size_t count) {
  const nlohmann::json::binary_t& packed = json.get_binary();
  if (!may_hold(packed, count, sizeof(T))) throw std::runtime_error("an array is too short");
  std::vector<T> values(count);
  if (!inflate_into(packed, std::as_writable_bytes(std::span(values)))) throw std::runtime_error("an array is damaged");
  return values;
}

}  // namespace sunfleck

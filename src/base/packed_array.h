#pragma once
// Stores long arrays of numbers as CBOR byte strings, little-endian and deflated (zlib streams of 256 KiB, one after the other),
// and reads CBOR from untrusted files.

#include "base/error.h"
#include "base/number_pieces.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sunfleck {

static_assert(std::endian::native == std::endian::little);

// Parses CBOR. Throws std::runtime_error for malformed bytes, and for lists and maps nested more than `deepest` levels: the
// library's parser recurses once per level of the file.
[[nodiscard]] nlohmann::json read_cbor(std::string_view bytes, std::size_t deepest);

// Returns the value as a T. Throws std::runtime_error unless it is a whole number in the range of T.
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

// Returns the deflated bytes of all pieces together, of which there are about `expected_bytes`, or 0 if nobody knows.
[[nodiscard]] nlohmann::json::binary_t deflated(const NumberPieces<std::byte>& pieces, std::size_t expected_bytes);

// Fills `bytes`. Returns false if the packed bytes are damaged or hold a different number of bytes.
[[nodiscard]] bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes);

// Returns false if the packed bytes are too few for `count` values: deflate expands at most 1032 times (zlib's technical
// details).
[[nodiscard]] bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size);

template <class T>
[[nodiscard]] nlohmann::json pack(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
  return nlohmann::json::binary(deflated([&](const auto& take) { take(bytes); }, bytes.size()));
}

// `count` is their number, or 0 if nobody knows it.
template <class T>
[[nodiscard]] nlohmann::json pack(const NumberPieces<T>& pieces, std::size_t count) {
  return nlohmann::json::binary(deflated(
      [&](const auto& take) { pieces([&](std::span<const T> piece) { take(std::as_bytes(piece)); }); }, count * sizeof(T)));
}

// Returns `count` values. Throws std::runtime_error if a different number was packed.
template <class T>
[[nodiscard]] std::vector<T> unpack(const nlohmann::json& json, std::size_t count) {
  const nlohmann::json::binary_t& packed = json.get_binary();
  if (!may_hold(packed, count, sizeof(T))) throw std::runtime_error("an array is too short");
  std::vector<T> values(count);
  if (!inflate_into(packed, std::as_writable_bytes(std::span(values)))) throw std::runtime_error("an array is damaged");
  return values;
}

}  // namespace sunfleck

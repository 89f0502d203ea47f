#pragma once
// Stores long arrays of numbers as CBOR, and reads CBOR from untrusted files.
//
// An array is cut into blocks of 256 KiB, and a block into planes: the lowest bytes of all its words, then the next bytes, and so
// on. High bytes are much the same from word to word and become few, low bytes are often as good as random and are kept as they
// are. Each plane is a zlib stream; all streams stand one after the other in a byte string, under the key "planes" of a map. An
// array of bytes is such a byte string itself, and so is any array in a file from an earlier build, whose words were not taken
// apart.

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

// Returns the deflated bytes of all pieces together, of which there are about `expected_bytes`, or 0 if nobody knows: whole
// words of `word` bytes, 1, 2, 4 or 8.
[[nodiscard]] nlohmann::json::binary_t deflated(const NumberPieces<std::byte>& pieces, std::size_t word,
                                                std::size_t expected_bytes);

// Fills `bytes`. Returns false if the packed bytes are damaged or hold a different number of bytes.
[[nodiscard]] bool inflate_into(const nlohmann::json::binary_t& packed, std::size_t word, std::span<std::byte> bytes);

// Returns false if the packed bytes are too few for `count` values: deflate expands at most 1032 times (zlib's technical
// details).
[[nodiscard]] bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size);

// Words are as large as the numbers that a T consists of.
template <class T>
inline constexpr std::size_t word_bytes = alignof(T);

// `count` is the number of values, or 0 if nobody knows it.
template <class T>
[[nodiscard]] nlohmann::json pack(const NumberPieces<T>& pieces, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  const NumberPieces<std::byte> bytes = [&](const auto& take) {
    pieces([&](std::span<const T> piece) { take(std::as_bytes(piece)); });
  };
  nlohmann::json packed = nlohmann::json::binary(deflated(bytes, word_bytes<T>, count * sizeof(T)));
  if constexpr (word_bytes<T> == 1) return packed;
  nlohmann::json planes;
  planes["planes"] = std::move(packed);
  return planes;
}

template <class T>
[[nodiscard]] nlohmann::json pack(const std::vector<T>& values) {
  return pack(NumberPieces<T>([&](const auto& take) { take(std::span(values)); }), values.size());
}

// Returns `count` values. Throws std::runtime_error if a different number was packed.
template <class T>
[[nodiscard]] std::vector<T> unpack(const nlohmann::json& json, std::size_t count) {
  const bool whole_words = json.is_binary();
  const nlohmann::json::binary_t& packed = (whole_words ? json : json.at("planes")).get_binary();
  if (!may_hold(packed, count, sizeof(T))) throw std::runtime_error("an array is too short");
  std::vector<T> values(count);
  const std::size_t word = whole_words ? 1 : word_bytes<T>;
  if (!inflate_into(packed, word, std::as_writable_bytes(std::span(values)))) {
    throw std::runtime_error("an array is damaged");
  }
  return values;
}

}  // namespace sunfleck

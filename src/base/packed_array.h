#pragma once
// Stores long arrays of numbers as CBOR, and reads CBOR from untrusted files.
//
// An array is cut into blocks of 256 KiB, and each block becomes a zlib stream; all streams stand one after the other in a byte
// string. A block of whole numbers of 64 bits, or of floating-point numbers, is first taken apart into planes: the lowest bytes
// of all its words, then the next bytes, and so on. High bytes hardly differ from word to word and shrink to little; low bytes
// are often as good as random and are stored as they are. Each plane is a stream, and the byte string stands under the key
// "planes" of a map. Files from earlier builds have no planes, and streams of any length.

#include "base/error.h"
#include "base/number_pieces.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
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

// Returns the deflated bytes of all pieces together, of which there are about `expected_bytes`, or 0 if nobody knows. They are
// taken apart into as many planes as a word has bytes, 1, 4 or 8, and are whole words.
[[nodiscard]] nlohmann::json::binary_t deflated(const NumberPieces<std::byte>& pieces, std::size_t word,
                                                std::size_t expected_bytes);

// Fills `bytes`. Returns false if the packed bytes are damaged or hold a different number of bytes.
[[nodiscard]] bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes);
// Does the same with bytes that were taken apart into planes.
[[nodiscard]] bool inflate_planes_into(const nlohmann::json::binary_t& packed, std::size_t word, std::span<std::byte> bytes);

// Returns false if the packed bytes are too few for `count` values: deflate expands at most 1032 times (zlib's technical
// details).
[[nodiscard]] bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size);

// Returns the number of planes. Parts of structures repeat as a whole, which planes would hide from deflate.
template <class T>
inline constexpr std::size_t planes_of = std::is_floating_point_v<T> || (std::is_integral_v<T> && sizeof(T) == 8) ? sizeof(T)
                                                                                                                  : 1;

// `count` is the number of values, or 0 if nobody knows it.
template <class T>
[[nodiscard]] nlohmann::json pack(const NumberPieces<T>& pieces, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  const NumberPieces<std::byte> bytes = [&](const auto& take) {
    pieces([&](std::span<const T> piece) { take(std::as_bytes(piece)); });
  };
  nlohmann::json packed = nlohmann::json::binary(deflated(bytes, planes_of<T>, count * sizeof(T)));
  if constexpr (planes_of<T> == 1) return packed;
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
  const bool in_planes = planes_of<T> > 1 && json.is_object();
  const nlohmann::json::binary_t& packed = (in_planes ? json.at("planes") : json).get_binary();
  if (!may_hold(packed, count, sizeof(T))) throw std::runtime_error("an array is too short");
  std::vector<T> values(count);
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(values));
  const bool good = in_planes ? inflate_planes_into(packed, planes_of<T>, bytes) : inflate_into(packed, bytes);
  if (!good) throw std::runtime_error("an array is damaged");
  return values;
}

}  // namespace sunfleck

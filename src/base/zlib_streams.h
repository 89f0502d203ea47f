#pragma once
// Deflates numbers quickly that were taken apart into planes: the lowest bytes of all words, then the next bytes, and so on.
// Low bytes are often as good as random.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;

namespace sunfleck {

// Returns whether deflate would hardly shrink the bytes: among some of them, and among these and their neighbours, fewer than
// 1.5 times as many pairs are equal as among random bytes.
[[nodiscard]] bool look_random(std::span<const std::byte> bytes);

// Makes streams (RFC 1950), one after the other.
class ZlibStreams {
 public:
  ZlibStreams();

  // Appends the stream of the bytes, the first of which are stored as they are.
  void append(std::span<const std::byte> bytes, std::size_t stored, std::vector<std::uint8_t>& to) const;

 private:
  std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor_;
};

}  // namespace sunfleck

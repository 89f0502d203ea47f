#include "base/zlib_streams.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <new>

namespace sunfleck {
namespace {

constexpr int fastest = 1;

}  // namespace

bool look_random(std::span<const std::byte> bytes) {
  constexpr std::size_t step = 8;
  constexpr std::size_t least_bytes = std::size_t{1} << 12U;
  if (bytes.size() < least_bytes) return false;
  std::array<std::uint64_t, 256> counts{};
  std::uint64_t sampled = 0;
  std::uint64_t equal_neighbours = 0;
  for (std::size_t k = 0; k + 1 < bytes.size(); k += step, ++sampled) {
    ++counts[std::to_integer<std::size_t>(bytes[k])];
    if (bytes[k] == bytes[k + 1]) ++equal_neighbours;
  }
  std::uint64_t equal_pairs = 0;
  for (const std::uint64_t count : counts) equal_pairs += count * (count - 1);
  const auto few = [&](std::uint64_t equal, std::uint64_t pairs) { return 2 * counts.size() * equal < 3 * pairs; };
  return few(equal_pairs, sampled * (sampled - 1)) && few(equal_neighbours, sampled);
}

ZlibStreams::ZlibStreams() : compressor_(libdeflate_alloc_compressor(fastest), &libdeflate_free_compressor) {
  if (!compressor_) throw std::bad_alloc();
}

// Stored bytes stand in blocks of their own (RFC 1951), before those that libdeflate makes, the last of which ends the stream.
// A compressor that only stores would take as much memory as one that deflates.
void ZlibStreams::append(std::span<const std::byte> bytes, std::size_t stored, std::vector<std::uint8_t>& to) const {
  constexpr std::size_t longest_block = 0xffff;
  const auto append = [&](std::initializer_list<std::size_t> some) {
    for (const std::size_t byte : some) to.push_back(static_cast<std::uint8_t>(byte));
  };
  append({0x78, 0x01});
  for (std::size_t first = 0; first < stored; first += longest_block) {
    const std::span<const std::byte> block = bytes.subspan(first, std::min(longest_block, stored - first));
    const bool ends = first + block.size() == bytes.size();
    append({ends ? 1U : 0U, block.size(), block.size() >> 8U, ~block.size(), ~block.size() >> 8U});
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(block.data());
    to.insert(to.end(), begin, begin + block.size());
  }
  if (const std::span<const std::byte> rest = bytes.subspan(stored); !rest.empty() || bytes.empty()) {
    const std::size_t before = to.size();
    to.resize(before + libdeflate_deflate_compress_bound(compressor_.get(), rest.size()));
    to.resize(before +
              libdeflate_deflate_compress(compressor_.get(), rest.data(), rest.size(), &to[before], to.size() - before));
  }
  const std::uint32_t checksum = libdeflate_adler32(1, bytes.data(), bytes.size());
  append({checksum >> 24U, checksum >> 16U, checksum >> 8U, checksum});
}

}  // namespace sunfleck

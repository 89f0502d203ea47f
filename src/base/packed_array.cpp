#include "base/packed_array.h"

#include "base/in_blocks.h"
#include "base/large_pages.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

namespace sunfleck {
namespace {

using nlohmann::json;

// Checks only the nesting depth.
class DepthCheck : public nlohmann::json_sax<json> {
 public:
  explicit DepthCheck(std::size_t deepest) : deepest_(deepest) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= deepest_; }
  bool start_array(std::size_t) override { return ++depth_ <= deepest_; }
  bool end_object() override { return depth_-- > 0; }
  bool end_array() override { return depth_-- > 0; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 private:
  std::size_t deepest_, depth_ = 0;
};

// Number of bytes in a stream. Streams are deflated side by side; longer ones would hardly be smaller.
constexpr std::size_t stream_bytes = std::size_t{1} << 18U;
constexpr std::size_t bytes_at_once = 16 * stream_bytes;

// Deflates streams one after the other.
class StreamDeflater {
 public:
  StreamDeflater() : compressor_(libdeflate_alloc_compressor(fastest), &libdeflate_free_compressor) {
    if (!compressor_) throw std::bad_alloc();
    space_.resize(libdeflate_zlib_compress_bound(compressor_.get(), stream_bytes));
  }

  void deflate(std::span<const std::byte> bytes) {
    packed_ = libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(), space_.data(), space_.size());
  }

  // Returns what the last stream became.
  [[nodiscard]] std::span<const std::uint8_t> packed() const { return std::span(space_).first(packed_); }

 private:
  static constexpr int fastest = 1;
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
  std::vector<std::uint8_t> space_;
  std::size_t packed_ = 0;
};

class Deflater {
 public:
  // Expects about as many bytes, and leaves room for those of the streams themselves. What is reserved and not needed is hardly
  // ever touched.
  explicit Deflater(std::size_t expected_bytes) {
    constexpr std::size_t least_bytes = 64;
    constexpr std::size_t part = 256;
    waiting_.reserve(std::min(bytes_at_once, expected_bytes));
    packed_.reserve(least_bytes + expected_bytes + expected_bytes / part);
    prefer_large_pages(packed_.data(), packed_.capacity());
  }

  void add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto taken = bytes.first(std::min(bytes.size(), bytes_at_once - waiting_.size()));
      bytes = bytes.subspan(taken.size());
      if (taken.size() == bytes_at_once) {
        deflate(taken);
        continue;
      }
      waiting_.insert(waiting_.end(), taken.begin(), taken.end());
      if (waiting_.size() == bytes_at_once) deflate_waiting();
    }
  }

  json::binary_t finish() {
    deflate_waiting();
    return std::move(packed_);
  }

 private:
  void deflate_waiting() {
    deflate(waiting_);
    waiting_.clear();
  }

  void deflate(std::span<const std::byte> bytes) {
    const std::size_t count = block_count(bytes.size(), stream_bytes);
    deflaters_.resize(std::max(deflaters_.size(), count));
    in_blocks(bytes.size(), stream_bytes, [&](std::size_t k, std::size_t first, std::size_t end) {
      deflaters_[k].deflate(bytes.subspan(first, end - first));
    });
    for (const StreamDeflater& deflater : std::span(deflaters_).first(count)) {
      const std::span<const std::uint8_t> stream = deflater.packed();
      packed_.insert(packed_.end(), stream.begin(), stream.end());
    }
  }

  std::vector<std::byte> waiting_;
  std::vector<StreamDeflater> deflaters_;  // one for each stream that is deflated at the same time
  json::binary_t packed_{std::vector<std::uint8_t>{}};
};

}  // namespace

json read_cbor(std::string_view bytes, std::size_t deepest) {
  DepthCheck check(deepest);
  if (!json::sax_parse(bytes, &check, json::input_format_t::cbor)) throw std::runtime_error("it is truncated or damaged");
  return json::from_cbor(bytes);
}

json::binary_t deflated(const NumberPieces<std::byte>& pieces, std::size_t expected_bytes) {
  Deflater deflater(expected_bytes);
  pieces([&](std::span<const std::byte> piece) { deflater.add(piece); });
  return deflater.finish();
}

bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::span<const std::uint8_t> rest = packed;
  while (!rest.empty()) {
    std::size_t taken = 0;
    std::size_t got = 0;
    const libdeflate_result result =
        libdeflate_zlib_decompress_ex(decompressor.get(), rest.data(), rest.size(), bytes.data(), bytes.size(), &taken, &got);
    if (result != LIBDEFLATE_SUCCESS) return false;
    rest = rest.subspan(taken);
    bytes = bytes.subspan(got);
  }
  return bytes.empty();
}

bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size) {
  constexpr std::size_t most_ratio = 1032;
  return count <= std::numeric_limits<std::size_t>::max() / size && count * size / most_ratio <= packed.size();
}

}  // namespace sunfleck

#include "base/packed_array.h"

#include "base/in_blocks.h"
#include "base/large_pages.h"
#include "base/zlib_streams.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>

namespace sunfleck {
namespace {

using nlohmann::json;

// Builds the value that is read, unless it is too deep: each level takes room on the stack when the value is copied or destroyed.
class ShallowValue : public nlohmann::json_sax<json> {
 public:
  explicit ShallowValue(std::size_t deepest) : deepest_(deepest) {}

  [[nodiscard]] json finish() { return std::move(root_); }

  bool null() override { return take(nullptr); }
  bool boolean(bool value) override { return take(value); }
  bool number_integer(number_integer_t value) override { return take(value); }
  bool number_unsigned(number_unsigned_t value) override { return take(value); }
  bool number_float(number_float_t value, const string_t&) override { return take(value); }
  bool string(string_t& value) override { return take(std::move(value)); }
  bool binary(binary_t& value) override { return take(json::binary(std::move(value))); }
  bool key(string_t& value) override {
    key_ = std::move(value);
    return true;
  }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 private:
  // Puts a value where it belongs.
  json& place(json value) {
    if (open_.empty()) return root_ = std::move(value);
    json& whole = *open_.back();
    if (whole.is_object()) return whole[key_] = std::move(value);
    whole.push_back(std::move(value));
    return whole.back();
  }

  bool take(json value) {
    place(std::move(value));
    return true;
  }

  bool open(json whole) {
    if (open_.size() == deepest_) return false;
    open_.push_back(&place(std::move(whole)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::size_t deepest_;
  json root_;
  std::string key_;          // of the next value of an object
  std::vector<json*> open_;  // the lists and maps that are being read
};

// A block has this many bytes, whatever the size of its words. Blocks are deflated side by side; longer ones would hardly be
// smaller.
constexpr std::size_t block_bytes = std::size_t{1} << 18U;
constexpr std::size_t bytes_at_once = 8 * block_bytes;

using Decompressor = std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>;

Decompressor make_decompressor() {
  Decompressor decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  return decompressor;
}

// Packs blocks one after the other.
class BlockDeflater {
 public:
  void pack(std::span<const std::byte> block, std::size_t word) {
    const std::size_t words = block.size() / word;
    plane_.resize(words);
    packed_.clear();
    for (std::size_t k = 0; k < word; ++k) {
      for (std::size_t i = 0; i < words; ++i) plane_[i] = block[i * word + k];
      streams_.append(plane_, word > 1 && look_random(plane_) ? words : 0, packed_);
    }
  }

  // Returns what the last block became.
  [[nodiscard]] std::span<const std::uint8_t> packed() const { return packed_; }

 private:
  ZlibStreams streams_;
  std::vector<std::byte> plane_;
  std::vector<std::uint8_t> packed_;
};

class Deflater {
 public:
  // Expects about as many bytes, and leaves room for those of the streams themselves. What is reserved and not needed is hardly
  // ever touched.
  Deflater(std::size_t word, std::size_t expected_bytes) : word_(word) {
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
    const std::size_t count = block_count(bytes.size(), block_bytes);
    deflaters_.resize(std::max(deflaters_.size(), count));
    in_blocks(bytes.size(), block_bytes, [&](std::size_t k, std::size_t first, std::size_t end) {
      deflaters_[k].pack(bytes.subspan(first, end - first), word_);
    });
    for (const BlockDeflater& deflater : std::span(deflaters_).first(count)) {
      const std::span<const std::uint8_t> block = deflater.packed();
      packed_.insert(packed_.end(), block.begin(), block.end());
    }
  }

  std::size_t word_;
  std::vector<std::byte> waiting_;
  std::vector<BlockDeflater> deflaters_;  // one for each block that is deflated at the same time
  json::binary_t packed_{std::vector<std::uint8_t>{}};
};

// Inflates streams one after the other.
class Inflater {
 public:
  explicit Inflater(std::span<const std::uint8_t> packed) : rest_(packed) {}

  // Writes the next stream to the beginning of `bytes`. Returns its length, or nothing if it is damaged or longer.
  std::optional<std::size_t> next(std::span<std::byte> bytes) {
    std::size_t taken = 0;
    std::size_t got = 0;
    const libdeflate_result result = libdeflate_zlib_decompress_ex(decompressor_.get(), rest_.data(), rest_.size(),
                                                                   bytes.data(), bytes.size(), &taken, &got);
    if (result != LIBDEFLATE_SUCCESS) return std::nullopt;
    rest_ = rest_.subspan(taken);
    return got;
  }

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::uint8_t> rest_;
  Decompressor decompressor_ = make_decompressor();
};

}  // namespace

json read_cbor(std::string_view bytes, std::size_t deepest) {
  ShallowValue value(deepest);
  if (!json::sax_parse(bytes, &value, json::input_format_t::cbor)) throw std::runtime_error("it is truncated or damaged");
  return value.finish();
}

json::binary_t deflated(const NumberPieces<std::byte>& pieces, std::size_t word, std::size_t expected_bytes) {
  Deflater deflater(word, expected_bytes);
  pieces([&](std::span<const std::byte> piece) { deflater.add(piece); });
  return deflater.finish();
}

bool inflate_into(const json::binary_t& packed, std::span<std::byte> bytes) {
  Inflater inflater(packed);
  while (!inflater.at_end()) {
    const std::optional<std::size_t> got = inflater.next(bytes);
    if (!got) return false;
    bytes = bytes.subspan(*got);
  }
  return bytes.empty();
}

bool inflate_planes_into(const json::binary_t& packed, std::size_t word, std::span<std::byte> bytes) {
  Inflater inflater(packed);
  std::vector<std::byte> plane;
  for (std::size_t first = 0; first < bytes.size(); first += block_bytes) {
    const std::span<std::byte> block = bytes.subspan(first, std::min(block_bytes, bytes.size() - first));
    plane.resize(block.size() / word);
    for (std::size_t k = 0; k < word; ++k) {
      if (inflater.next(plane) != plane.size()) return false;
      for (std::size_t i = 0; i < plane.size(); ++i) block[i * word + k] = plane[i];
    }
  }
  return inflater.at_end();
}

bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size) {
  constexpr std::size_t most_ratio = 1032;
  return count <= std::numeric_limits<std::size_t>::max() / size && count * size / most_ratio <= packed.size();
}

}  // namespace sunfleck

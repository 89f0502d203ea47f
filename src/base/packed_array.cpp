#include "base/packed_array.h"

#include <zlib.h>

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

constexpr std::size_t most_at_once = std::size_t{1} << 30U;  // zlib counts in 32 bits

Bytef* bytes_of(const void* data) {
  return static_cast<Bytef*>(const_cast<void*>(data));
}

// Returns the bytes of all packed arrays in the value, which is nested no deeper than a file.
std::size_t packed_bytes(const json& value) {
  if (value.is_binary()) return value.get_binary().size();
  std::size_t bytes = 0;
  if (value.is_structured()) {
    for (const json& part : value) bytes += packed_bytes(part);
  }
  return bytes;
}

class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(std::span<const std::byte> bytes) {
    for (std::size_t given = 0; given < bytes.size();) {
      const std::size_t next = std::min(most_at_once, bytes.size() - given);
      stream_.next_in = bytes_of(bytes.data() + given);
      stream_.avail_in = static_cast<uInt>(next);
      given += next;
      deflate_into_packed(Z_NO_FLUSH);
    }
  }

  json::binary_t finish() {
    deflate_into_packed(Z_FINISH);
    packed_.shrink_to_fit();
    return std::move(packed_);
  }

 private:
  void deflate_into_packed(int flush) {
    do {
      stream_.next_out = chunk_.data();
      stream_.avail_out = static_cast<uInt>(chunk_.size());
      deflate(&stream_, flush);
      packed_.insert(packed_.end(), chunk_.data(), stream_.next_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_{};
  json::binary_t packed_{std::vector<std::uint8_t>{}};
  std::vector<std::uint8_t> chunk_ = std::vector<std::uint8_t>(std::size_t{1} << 18U);
};

}  // namespace

json read_cbor(std::string_view bytes, std::size_t deepest) {
  DepthCheck check(deepest);
  if (!json::sax_parse(bytes, &check, json::input_format_t::cbor)) throw std::runtime_error("it is truncated or damaged");
  return json::from_cbor(bytes);
}

void append_cbor(const json& value, std::string& bytes) {
  constexpr std::size_t other_values = std::size_t{1} << 16U;
  bytes.reserve(bytes.size() + packed_bytes(value) + other_values);
  json::to_cbor(value, bytes);
}

json::binary_t deflated(const NumberPieces<std::byte>& pieces) {
  Deflater deflater;
  pieces([&](std::span<const std::byte> piece) { deflater.add(piece); });
  return deflater.finish();
}

bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  std::size_t given = 0;
  std::size_t got = 0;
  std::byte beyond{};  // one extra byte reveals a longer array
  int status = Z_OK;
  while (status == Z_OK) {
    if (stream.avail_in == 0) {
      const std::size_t next = std::min(most_at_once, packed.size() - given);
      stream.next_in = bytes_of(packed.data() + given);
      stream.avail_in = static_cast<uInt>(next);
      given += next;
    }
    const bool full = got == bytes.size();
    const std::size_t room = full ? 1 : std::min(most_at_once, bytes.size() - got);
    stream.next_out = bytes_of(full ? &beyond : bytes.data() + got);
    stream.avail_out = static_cast<uInt>(room);
    status = inflate(&stream, Z_NO_FLUSH);
    got += room - stream.avail_out;
    if (got > bytes.size()) break;
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END && got == bytes.size();
}

bool may_hold(const nlohmann::json::binary_t& packed, std::size_t count, std::size_t size) {
  constexpr std::size_t most_ratio = 1032;
  return count <= std::numeric_limits<std::size_t>::max() / size && count * size / most_ratio <= packed.size();
}

}  // namespace sunfleck

#include "io/packed_array.h"

#include "base/check.h"

#include <zlib.h>

namespace sunfleck {
namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30U;  // zlib counts in 32 bits

Bytef* bytes_of(const void* data) {
  return static_cast<Bytef*>(const_cast<void*>(data));
}

}  // namespace

nlohmann::json::binary_t deflated(std::span<const std::byte> bytes) {
  z_stream stream{};
  EXPECT(deflateInit(&stream, Z_BEST_SPEED), ==, Z_OK);
  nlohmann::json::binary_t packed(std::vector<std::uint8_t>{});
  std::vector<std::uint8_t> chunk(std::size_t{1} << 18U);
  std::size_t given = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      const std::size_t next = std::min(most_at_once, bytes.size() - given);
      stream.next_in = bytes_of(bytes.data() + given);
      stream.avail_in = static_cast<uInt>(next);
      given += next;
    }
    stream.next_out = chunk.data();
    stream.avail_out = static_cast<uInt>(chunk.size());
    status = deflate(&stream, given == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.insert(packed.end(), chunk.data(), stream.next_out);
  }
  deflateEnd(&stream);
  return packed;
}

bool inflate_into(const nlohmann::json::binary_t& packed, std::span<std::byte> bytes) {
  z_stream stream{};
  EXPECT(inflateInit(&stream), ==, Z_OK);
  std::size_t given = 0;
  std::size_t got = 0;
  std::byte beyond{};  // one byte more than there may be tells a longer array
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

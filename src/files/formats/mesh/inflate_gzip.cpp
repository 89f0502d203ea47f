#include "files/formats/mesh/inflate_gzip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <string_view>

namespace sunfleck {

namespace {

struct InflateEnd {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

}  // namespace

std::string inflate_gzip(const MeshSource& source, std::size_t limit) {
  const auto broken = [&](std::string_view why) { refuse(source, 0, "broken gzip file", why, "compress the file again"); };
  z_stream stream{};
  constexpr int gzip_only = 16 + MAX_WBITS;
  if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, InflateEnd> owner(&stream);

  std::string text;
  std::string_view rest = source.bytes;
  int state = Z_OK;
  while (state != Z_STREAM_END || !rest.empty()) {
    if (state == Z_STREAM_END) inflateReset(&stream);  // a gzip file may have several members
    if (text.size() >= limit)
      refuse(source, 0, fmt::format("holds more than {} bytes", limit), "the limit for a compressed file", "split the file");
    const std::size_t have = text.size();
    text.resize(std::min(limit, std::max<std::size_t>(2 * have, 8 * source.bytes.size())));
    constexpr std::size_t piece = std::numeric_limits<uInt>::max();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
    stream.avail_in = static_cast<uInt>(std::min(rest.size(), piece));
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + have);
    stream.avail_out = static_cast<uInt>(std::min(text.size() - have, piece));
    const std::size_t room = stream.avail_out;
    const std::size_t given = stream.avail_in;
    state = inflate(&stream, Z_NO_FLUSH);
    rest.remove_prefix(given - stream.avail_in);
    text.resize(have + room - stream.avail_out);
    if (state == Z_BUF_ERROR || (state == Z_OK && rest.empty() && stream.avail_out > 0)) broken("it is truncated");
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state != Z_OK && state != Z_STREAM_END) broken(stream.msg != nullptr ? stream.msg : "not compressed by gzip");
  }
  return text;
}

}  // namespace sunfleck

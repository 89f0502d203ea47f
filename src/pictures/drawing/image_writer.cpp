#include "pictures/drawing/image_writer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <cstdlib>
#include <memory>

namespace sunfleck {
namespace {

// Deflates what stb_image_write has filtered, which frees the result; null without memory. Its own compression takes three times as
// long, and its files are larger.
unsigned char* deflated(unsigned char* bytes, int size, int* deflated_size, int /*quality*/) {
  constexpr int level = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) return nullptr;
  const std::size_t room = libdeflate_zlib_compress_bound(compressor.get(), static_cast<std::size_t>(size));
  auto* const result = static_cast<unsigned char*>(std::malloc(room));
  if (result == nullptr) return nullptr;
  const std::size_t taken = libdeflate_zlib_compress(compressor.get(), bytes, static_cast<std::size_t>(size), result, room);
  EXPECT(taken, >, std::size_t{0});
  *deflated_size = static_cast<int>(taken);
  return result;
}

}  // namespace
}  // namespace sunfleck

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBIW_ZLIB_COMPRESS sunfleck::deflated
#include <stb_image_write.h>

namespace sunfleck {

std::string encoded_png(const Image& image) {
  EXPECT(image.width, >, 0);
  EXPECT(image.height, >, 0);
  EXPECT(image.pixels.size(), ==, static_cast<std::size_t>(image.width) * image.height);
  constexpr int channels = 3;
  const auto append = [](void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  std::string bytes;
  const int encoded =
      stbi_write_png_to_func(append, &bytes, image.width, image.height, channels, image.pixels.data(), image.width * channels);
  return encoded == 0 ? std::string() : bytes;
}

void write_encoded_png(const std::string& bytes, const std::filesystem::path& file) {
  if (bytes.empty()) {
    throw_failure(fmt::format("{}: cannot be encoded as PNG", file.string()), "out of memory", "ask for a smaller picture");
  }
  write_file(file, bytes);
}

void write_png(const Image& image, const std::filesystem::path& file) {
  write_encoded_png(encoded_png(image), file);
}

}  // namespace sunfleck

#include "pictures/drawing/image_writer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"

#include <stb_image_write.h>

#include <fmt/format.h>

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

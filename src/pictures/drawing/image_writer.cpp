#include "pictures/drawing/image_writer.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"

#include <stb_image_write.h>

#include <fmt/format.h>

#include <string>

namespace sunfleck {

void write_png(const Image& image, const std::filesystem::path& file) {
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
  if (encoded == 0 || bytes.empty()) {
    throw_failure(fmt::format("{}: cannot encode {} x {} pixels as PNG", file.string(), image.width, image.height),
                  "out of memory", "ask for a smaller picture");
  }
  write_file(file, bytes);
}

}  // namespace sunfleck

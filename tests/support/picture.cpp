#include "support/picture.h"

#include <gtest/gtest.h>

#include <stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace sunfleck::test {

std::size_t Picture::count(const Pixel& colour, int tolerance) const {
  return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(), [&](const Pixel& pixel) {
    return std::abs(pixel[0] - colour[0]) <= tolerance && std::abs(pixel[1] - colour[1]) <= tolerance &&
           std::abs(pixel[2] - colour[2]) <= tolerance;
  }));
}

std::size_t Picture::count_between(const Pixel& colour, int left, int right) const {
  std::size_t count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = left; x < right; ++x) count += at(x, y) == colour ? 1 : 0;
  }
  return count;
}

Picture read_picture(const std::filesystem::path& file) {
  Picture picture;
  int channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
      stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3), stbi_image_free);
  EXPECT_TRUE(bytes) << file;
  if (!bytes) return {};
  picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  std::memcpy(picture.pixels.data(), bytes.get(), picture.pixels.size() * sizeof(Picture::Pixel));
  return picture;
}

}  // namespace sunfleck::test

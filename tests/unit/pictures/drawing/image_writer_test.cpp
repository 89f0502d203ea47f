#include "pictures/drawing/image_writer.h"

#include "base/error.h"
#include "support/error_text.h"

#include <gtest/gtest.h>

#include <stb_image.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace sunfleck {
namespace {

class ImageWriter : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("sunfleck_image_writer_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

Image pattern(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixels.push_back(
          {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11), static_cast<std::uint8_t>((x * y) % 251)});
    }
  }
  return image;
}

TEST_F(ImageWriter, WritesWhatAReaderGetsBack) {
  for (const Image& image : {pattern(1, 1), pattern(3, 2), pattern(97, 61)}) {
    const std::filesystem::path file = folder_ / "picture.png";
    write_png(image, file);
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> bytes(stbi_load(file.c_str(), &width, &height, &channels, 0),
                                                                stbi_image_free);
    ASSERT_TRUE(bytes);
    ASSERT_EQ(width, image.width);
    ASSERT_EQ(height, image.height);
    ASSERT_EQ(channels, 3);
    for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
      for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(bytes.get()[3 * pixel + i], image.pixels[pixel][i]);
    }
  }
}

TEST_F(ImageWriter, SaysWhenTheFolderIsMissing) {
  refusal_of([&] { write_png(pattern(2, 2), folder_ / "missing" / "picture.png"); }, ErrorKind::failure);
}

TEST_F(ImageWriter, RefusesAnImageWithoutAllItsPixels) {
  Image image = pattern(4, 4);
  image.pixels.pop_back();
  EXPECT_THROW(write_png(image, folder_ / "picture.png"), std::logic_error);
}

}  // namespace
}  // namespace sunfleck

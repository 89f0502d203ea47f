#include "pictures/drawing/exr_writer.h"

#include "base/error.h"
#include "base/file.h"
#include "support/error_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <tinyexr.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace sunfleck {
namespace {

ExrImage exr_pattern(int width, int height) {
  std::vector<float> values;
  std::vector<float> coverage;
  std::vector<std::uint32_t> elements;
  for (int i = 0; i < width * height; ++i) {
    values.push_back(1000.0F * std::sin(0.1F * static_cast<float>(i)));
    coverage.push_back(static_cast<float>(i % 5) / 4.0F);
    // too large for a float to hold exactly
    elements.push_back(i % 3 == 0 ? 0xffffffffU : 16777217U + static_cast<std::uint32_t>(i));
  }
  return {width, height, {{"Y", values}, {"A", coverage}, {"element", elements}}, "Y: W m-2; ⁻²"};
}

// Reads a file with an independent reader; its channels are in the order of their names.
class ReadBack {
 public:
  explicit ReadBack(const std::string& bytes) {
    const auto* memory = reinterpret_cast<const unsigned char*>(bytes.data());
    EXRVersion version;
    InitEXRHeader(&header);
    InitEXRImage(&image);
    EXPECT_EQ(ParseEXRVersionFromMemory(&version, memory, bytes.size()), TINYEXR_SUCCESS);
    EXPECT_EQ(version.multipart + version.tiled + version.non_image, 0);
    EXPECT_EQ(ParseEXRHeaderFromMemory(&header, &version, memory, bytes.size(), nullptr), TINYEXR_SUCCESS);
    EXPECT_EQ(LoadEXRImageFromMemory(&image, &header, memory, bytes.size(), nullptr), TINYEXR_SUCCESS);
  }
  ~ReadBack() {
    FreeEXRImage(&image);
    FreeEXRHeader(&header);
  }
  ReadBack(const ReadBack&) = delete;
  ReadBack& operator=(const ReadBack&) = delete;

  EXRHeader header;
  EXRImage image;
};

template <class T>
void expect_channel(const ReadBack& read, int channel, const std::string& name, int type, const std::vector<T>& values) {
  EXPECT_EQ(read.header.channels[channel].name, name);
  EXPECT_EQ(read.header.pixel_types[channel], type);
  EXPECT_EQ(std::memcmp(read.image.images[channel], values.data(), values.size() * sizeof(T)), 0) << name;
}

TEST(ExrWriter, WritesWhatAReaderGetsBack) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(37, 23), std::pair(300, 40)}) {
    const ExrImage image = exr_pattern(width, height);
    write_exr(image, folder / "values.exr");
    const std::string bytes = read_file(folder / "values.exr");
    EXPECT_EQ(bytes.substr(0, 4), "\x76\x2f\x31\x01");
    const ReadBack read(bytes);
    ASSERT_EQ(read.image.width, width);
    ASSERT_EQ(read.image.height, height);
    ASSERT_EQ(read.header.num_channels, 3);
    expect_channel(read, 0, "A", TINYEXR_PIXELTYPE_FLOAT, std::get<0>(image.channels[1].values));
    expect_channel(read, 1, "Y", TINYEXR_PIXELTYPE_FLOAT, std::get<0>(image.channels[0].values));
    expect_channel(read, 2, "element", TINYEXR_PIXELTYPE_UINT, std::get<1>(image.channels[2].values));
    ASSERT_EQ(read.header.num_custom_attributes, 1);
    const EXRAttribute& comments = read.header.custom_attributes[0];
    EXPECT_STREQ(comments.name, "comments");
    EXPECT_STREQ(comments.type, "string");
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(comments.value), static_cast<std::size_t>(comments.size)),
              image.comments);
  }
}

TEST(ExrWriter, SaysWhenTheFolderIsMissing) {
  const TempFolder folder;
  refusal_of([&] { write_exr(exr_pattern(2, 2), folder.path() / "missing" / "values.exr"); }, ErrorKind::failure);
}

TEST(ExrWriter, RefusesAnImageWithoutAllItsPixels) {
  const TempFolder folder;
  ExrImage image = exr_pattern(4, 4);
  std::get<0>(image.channels[0].values).pop_back();
  EXPECT_THROW(write_exr(image, folder / "values.exr"), std::logic_error);
}

}  // namespace
}  // namespace sunfleck

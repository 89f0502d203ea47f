#pragma once
// Support for tests that draw with the real gnuplot and examine the pictures. Without the program they are skipped and say so,
// or fail if SUNFLECK_REQUIRE_DEVICE=1 is set.

#include "files/results/plots/plots.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace sunfleck::test {

struct Picture {
  using Pixel = std::array<std::uint8_t, 3>;
  int width = 0, height = 0;
  std::vector<Pixel> pixels;

  [[nodiscard]] Pixel at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y) * width + x); }
  // Counts the pixels of this colour, each channel within `tolerance`.
  [[nodiscard]] std::size_t count(const Pixel& colour, int tolerance = 0) const {
    return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(), [&](const Pixel& pixel) {
      return std::abs(pixel[0] - colour[0]) <= tolerance && std::abs(pixel[1] - colour[1]) <= tolerance &&
             std::abs(pixel[2] - colour[2]) <= tolerance;
    }));
  }
};

inline Picture read_picture(const std::filesystem::path& file) {
  Picture picture;
  int channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
      stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3), stbi_image_free);
  EXPECT_TRUE(bytes) << file;
  if (!bytes) return {};
  for (std::size_t i = 0; i < static_cast<std::size_t>(picture.width) * picture.height; ++i)
    picture.pixels.push_back({bytes.get()[3 * i], bytes.get()[3 * i + 1], bytes.get()[3 * i + 2]});
  return picture;
}

inline std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class GnuplotTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto warning = draw_plot("set terminal pngcairo\nplot x\n", folder_ / "probe.png");
    if (!warning) return;
    const char* required = std::getenv("SUNFLECK_REQUIRE_DEVICE");
    if (required != nullptr && std::string(required) == "1") FAIL() << *warning;
    GTEST_SKIP() << *warning;
  }

  // Draws twice with a script of share/plots, expects the same bytes, and reads them.
  [[nodiscard]] Picture draw(const char* script, const PlotVariables& variables) const {
    const std::filesystem::path first = folder_ / "first.png", second = folder_ / "second.png";
    EXPECT_EQ(draw_table(script, variables, first).value_or(""), "");
    EXPECT_EQ(draw_table(script, variables, second).value_or(""), "");
    EXPECT_EQ(file_bytes(first), file_bytes(second));
    return read_picture(first);
  }

  TempFolder folder_;
};

}  // namespace sunfleck::test

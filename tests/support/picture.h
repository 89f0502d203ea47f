#pragma once
// Pictures as tests examine them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sunfleck::test {

struct Picture {
  using Pixel = std::array<std::uint8_t, 3>;
  int width = 0, height = 0;
  std::vector<Pixel> pixels;

  [[nodiscard]] Pixel at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y) * width + x); }
  // Counts the pixels of this colour, each channel within `tolerance`.
  [[nodiscard]] std::size_t count(const Pixel& colour, int tolerance = 0) const;
  // Counts those of exactly this colour from column `left` to before `right`.
  [[nodiscard]] std::size_t count_between(const Pixel& colour, int left, int right) const;
};

// Fails the test if the file cannot be read.
[[nodiscard]] Picture read_picture(const std::filesystem::path& file);

}  // namespace sunfleck::test

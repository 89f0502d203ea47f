#pragma once
// White images to draw on, and their pixels.

#include "pictures/drawing/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sunfleck::test {

using Pixel = std::array<std::uint8_t, 3>;

inline constexpr Pixel white_pixel = {255, 255, 255};

inline Image white_image(int width, int height) {
  return {width, height, std::vector<Pixel>(static_cast<std::size_t>(width) * height, white_pixel)};
}

inline Pixel pixel_at(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y) * image.width + x];
}

}  // namespace sunfleck::test

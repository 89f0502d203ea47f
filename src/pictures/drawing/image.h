#pragma once
// A picture in memory.

#include <array>
#include <cstdint>
#include <vector>

namespace sunfleck {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;  // [row from the top][column], sRGB
};

}  // namespace sunfleck

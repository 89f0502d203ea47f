#include "pictures/drawing/viridis.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sunfleck {
namespace {

// sRGB, evenly spaced.
constexpr std::array<std::array<std::uint8_t, 3>, 16> control = {{{0x44, 0x01, 0x54},
                                                                  {0x48, 0x1a, 0x6c},
                                                                  {0x47, 0x2f, 0x7d},
                                                                  {0x41, 0x44, 0x87},
                                                                  {0x39, 0x56, 0x8c},
                                                                  {0x31, 0x68, 0x8e},
                                                                  {0x2a, 0x78, 0x8e},
                                                                  {0x23, 0x88, 0x8e},
                                                                  {0x1f, 0x98, 0x8b},
                                                                  {0x22, 0xa8, 0x84},
                                                                  {0x35, 0xb7, 0x79},
                                                                  {0x54, 0xc5, 0x68},
                                                                  {0x7a, 0xd1, 0x51},
                                                                  {0xa5, 0xdb, 0x36},
                                                                  {0xd2, 0xe2, 0x1b},
                                                                  {0xfd, 0xe7, 0x25}}};

}  // namespace

Colour viridis(double at) {
  const double place = std::clamp(at, 0.0, 1.0) * (control.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(place), control.size() - 2);
  const double part = place - static_cast<double>(first);
  Colour srgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    srgb[i] = ((1.0 - part) * control[first][i] + part * control[first + 1][i]) / 255.0;
  }
  return from_encoded(srgb);
}

}  // namespace sunfleck

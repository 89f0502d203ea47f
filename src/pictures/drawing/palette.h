#pragma once
// Colours of a chart's furniture, sRGB: near-black ink, greys for secondary elements, a soft sky.

#include <array>
#include <cstdint>

namespace sunfleck {

inline constexpr std::array<std::uint8_t, 3> ink = {32, 36, 42};
inline constexpr std::array<std::uint8_t, 3> grey_ink = {84, 90, 98};
inline constexpr std::array<std::uint8_t, 3> sky_top = {251, 252, 253};
inline constexpr std::array<std::uint8_t, 3> sky_bottom = {233, 237, 241};
inline constexpr std::array<std::array<std::uint8_t, 3>, 3> axis_srgb = {{{205, 32, 38}, {24, 138, 52}, {34, 76, 208}}};

}  // namespace sunfleck

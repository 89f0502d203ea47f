#pragma once
// The colour map viridis of Nathaniel Smith and Stefan van der Walt (2015, matplotlib, dedicated to the public domain, CC0):
// even in lightness, and legible without colour vision and in greyscale print.

#include "view/colour_scale.h"

namespace sunfleck {

// From 0, dark violet, to 1, yellow; what lies outside takes the nearest end. Interpolated in sRGB between 16 of the map's
// colours: at most 3 of 255 off the full table.
[[nodiscard]] Colour viridis(double at);

}  // namespace sunfleck

#pragma once
// The colour map viridis of Nathaniel Smith and Stefan van der Walt (2015, matplotlib, dedicated to the public domain, CC0):
// perceptually uniform, and legible without colour vision and in greyscale print.

#include "pictures/drawing/colour_scale.h"

namespace sunfleck {

// Returns a colour from 0, dark violet, to 1, yellow; values outside take the nearer end. Interpolates in sRGB between 16 of
// the map's colours, which deviates by at most 3 of 255 from the full table.
[[nodiscard]] Colour viridis(double at);

}  // namespace sunfleck

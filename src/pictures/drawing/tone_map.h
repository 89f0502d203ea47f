#pragma once
// Hue mapping: every surface keeps its own colour, and its irradiance shows as brightness. This is the photographic tone
// reproduction of Reinhard, Stark, Shirley and Ferwerda 2002 (ACM Transactions on Graphics 21:267), cited below by equation
// number, applied to the surfaces of the scene instead of the pixels of a photograph.
//
// A surface of reflectance (r, g, b) under irradiance E gets the linear colour
//
//   (r, g, b) * (E / Em) * Ld / L,
//
// where
//   Em = exp(sum A ln E / sum A)            eq. 1: log-mean irradiance of all lit surfaces, each weighted with its area A: both
//                                           faces of every element, and the soil's cells. The paper adds a small delta to
//                                           every value because of the logarithm of 0. Most faces of a canopy receive no
//                                           beam at all, so that delta alone would determine the mean. Here delta is 0, and
//                                           surfaces without light are left out: they are black whatever the mean
//   L  = Y(r, g, b) * E / Em                eq. 2: middle grey is a card of reflectance a = 0.18 under the log-mean
//                                           irradiance, so that a / (a Em) is the factor of luminance Y E
//   Y  = 0.2126 r + 0.7152 g + 0.0722 b     luminance of linear sRGB (ITU-R BT.709)
//   Ld = L (1 + L / Lwhite^2) / (1 + L)     eq. 4: compresses highlights. Only luminance is compressed; the ratios of r, g and
//                                           b stay
//   Lwhite = 1.25 L995                      0.5 % of the surfaces' area has a larger luminance than L995. The paper's default,
//                                           the largest luminance, would be the noise of the smallest triangle; and full white
//                                           is a quarter brighter than L995, so that a leaf in full sun is still green.
//
// Values above 1 are clipped when the colour is written as sRGB.

#include "pictures/drawing/colour_scale.h"

#include <span>

namespace sunfleck {

struct ToneMap {
  double log_mean_w_m2 = 0.0;  // Em; 0 if nothing is lit, and then everything is black
  double white = 1.0;          // Lwhite
};

// Returns the tone map. irradiance_w_m2, area_m2 and reflectance are [surface] and finite; areas are not negative. Surfaces
// without area do not count.
[[nodiscard]] ToneMap make_tone_map(std::span<const double> irradiance_w_m2, std::span<const double> area_m2,
                                    std::span<const Colour> reflectance);

[[nodiscard]] Colour hue_colour(const ToneMap& map, const Colour& reflectance, double irradiance_w_m2);

// Returns Y.
[[nodiscard]] double luminance(const Colour& linear);

}  // namespace sunfleck

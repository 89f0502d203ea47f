#pragma once
// Radiance of the sky models as their authors give it, up to a common factor. Sky scales it and draws from it.

#include "light/sky.h"

namespace sunfleck {

// The shape of a sky, l = gradation(zenith angle) * indicatrix(angle to the sun), as in ISO 15469:2004 and in the
// all-weather model: gradation = 1 + a exp(b / cos theta), indicatrix = 1 + c (exp(d chi) - offset) + e cos^2 chi; neither
// falls below 0.
struct SkyShape {
  double a = 0.0, b = -1.0, c = 0.0, d = -1.0, e = 0.0;
  double offset = 0.0;    // exp(d pi / 2) in the standard, 0 in the all-weather model
  double overcast = 0.0;  // Moon and Spencer 1942: the gradation is 1 + overcast * cos theta instead

  // Returns the gradation for cos_zenith > 0; the horizon is its limit.
  [[nodiscard]] double gradation(double cos_zenith) const;
  [[nodiscard]] double indicatrix(double cos_to_sun) const;
};

// Returns the shape of a sky other than a list of lights (EXPECT). `sun` matters only for all_weather.
[[nodiscard]] SkyShape sky_shape(const SkyModel& model, const SunPosition& sun);

}  // namespace sunfleck

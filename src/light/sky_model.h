#pragma once
// Radiance of the sky models as their authors give it, to any common factor. Sky brings it to scale and draws from it.

#include "light/sky.h"

namespace sunfleck {

// l = gradation(zenith angle) * indicatrix(angle to the sun), as in ISO 15469:2004 and in the all-weather model:
// gradation = 1 + a exp(b / cos theta), indicatrix = 1 + c (exp(d chi) - offset) + e cos^2 chi; neither falls below 0.
struct SkyShape {
  double a = 0.0, b = -1.0, c = 0.0, d = -1.0, e = 0.0;
  double offset = 0.0;    // exp(d pi / 2) in the standard, 0 in the all-weather model
  double overcast = 0.0;  // Moon and Spencer 1942: the gradation is 1 + overcast * cos theta instead

  // cos_zenith > 0; at the horizon the limit.
  [[nodiscard]] double gradation(double cos_zenith) const;
  [[nodiscard]] double indicatrix(double cos_to_sun) const;
};

// Not for lights (EXPECT). `sun` matters for all_weather alone.
[[nodiscard]] SkyShape sky_shape(const SkyModel& model, const SunPosition& sun);

}  // namespace sunfleck

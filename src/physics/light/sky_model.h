#pragma once
// The sky as a scene describes it, and the radiance of the sky models as their authors give it, up to a common factor. Sky
// scales it and draws from it.

#include "physics/light/sun.h"

#include <glm/vec3.hpp>
#include <vector>

namespace sunfleck {

enum class SkyKind { uniform, overcast, general, all_weather, lights };

// Smallest sine of elevation of any direction of a sky, drawn or listed: a level ray would never leave an endless plot.
inline constexpr double least_sky_sine = 1e-6;

// One direction of a list, as CARIBU uses it: `weight` is its share of the horizontal irradiance, up to a common factor.
struct SkyLight {
  double weight = 0.0;         // at least 0
  glm::dvec3 to_sky{0, 1, 0};  // unit vector, y at least least_sky_sine
};

inline constexpr int cie_clear_type = 12;  // of ISO 15469:2004

// The sky as a scene describes it; its radiance follows once the sun is known.
struct SkyModel {
  SkyKind kind = SkyKind::uniform;
  int cie_type = cie_clear_type;  // general: type 1 to 15 of ISO 15469:2004
  double dni_w_m2 = 0.0;          // all_weather: broadband direct normal irradiance
  double dhi_w_m2 = 0.0;          // all_weather: broadband diffuse horizontal irradiance, > 0
  std::vector<SkyLight> lights;   // lights: at least one with a positive weight

  // Returns true if the radiance depends on the sun's position, as for types 2, 4 and 6 to 15, and all_weather.
  [[nodiscard]] bool follows_sun() const;
};

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

// The parameters of the all-weather model for one moment (Perez, Seals and Michalsky 1993, Solar Energy 50:235), dhi_w_m2 >
// 0. Clearness is limited to at most 12.01, brightness to 0.01..0.6 (0.2..0.6 in bins 2 to 5), b to values below 0, and a to
// values that keep the zenith's radiance from being negative.
struct AllWeather {
  double clearness = 1.0;   // epsilon
  double brightness = 0.0;  // delta
  int bin = 1;              // 1..8
  SkyShape shape;
};
[[nodiscard]] AllWeather all_weather(double dni_w_m2, double dhi_w_m2, const SunPosition& sun);

}  // namespace sunfleck

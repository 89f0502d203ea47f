#pragma once
// Sunrise, transit and sunset.

#include <optional>

#include "light/sun.h"

namespace sunfleck {

// The convention of almanacs and of Reda and Andreas (2004), A.2: refraction 34', semi-diameter 16'.
inline constexpr double rise_set_elevation_rad = -0.8333 * 3.14159265358979323846 / 180.0;

struct SunEvents {
  std::optional<UtcTime> sunrise;  // empty where the sun does not rise before its transit (polar day or night)
  UtcTime transit;                 // highest stand, over the meridian; exists in polar night too
  std::optional<UtcTime> sunset;   // empty where the sun does not set after its transit
};

struct LocalDate {
  int year = 2000;
  int month = 1;
  int day = 1;
  int offset_minutes = 0;  // local time minus UTC
};

// The daylight of a local date: the transit next to its local noon, the rise before and the set after it, in UTC to 0.1 s.
// Near the poles in summer rise and set may fall on the neighbouring dates. Dates outside 1900..2100 or that do not exist:
// Error of kind input. The sea-level horizon counts, as in almanacs.
[[nodiscard]] SunEvents sun_events(const LocalDate& date, const Place& place);

}  // namespace sunfleck

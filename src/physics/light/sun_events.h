#pragma once
// Sunrise, transit and sunset.

#include <numbers>
#include <optional>

#include "physics/light/sun.h"

namespace sunfleck {

// The convention of almanacs and of Reda and Andreas (2004), A.2: refraction 34', semi-diameter 16'.
inline constexpr double rise_set_elevation_rad = -0.8333 * std::numbers::pi / 180.0;

struct SunEvents {
  std::optional<UtcTime> sunrise;  // empty if the sun does not rise before its transit (polar day or night)
  UtcTime transit;                 // highest position, on the meridian; exists in polar night too
  std::optional<UtcTime> sunset;   // empty if the sun does not set after its transit
};

struct LocalDate {
  int year = 2000;
  int month = 1;
  int day = 1;
  int offset_minutes = 0;  // local time minus UTC
};

// Returns the daylight of a local date: the transit next to its local noon, the rise before and the set after it, in UTC to
// 0.1 s. Near the poles in summer, rise and set may fall on the neighbouring dates. The sea-level horizon counts, as in
// almanacs. Throws Error (input) for dates that do not exist or lie outside 1900..2100.
[[nodiscard]] SunEvents sun_events(const LocalDate& date, const Place& place);

}  // namespace sunfleck

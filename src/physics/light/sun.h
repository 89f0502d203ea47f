#pragma once
// The position of the sun, from angles or from date, time and place.

#include <compare>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace sunfleck {

// Azimuth clockwise from north, elevation from the horizon; true position (without refraction) unless stated otherwise.
struct SunPosition {
  double elevation_rad = 0.0;
  double azimuth_rad = 0.0;
};

// Coordinated universal time in the proleptic Gregorian calendar. A leap second is second 60.
struct UtcTime {
  int year = 2000;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  double second = 0.0;

  friend auto operator<=>(const UtcTime&, const UtcTime&) = default;  // NOLINT(modernize-use-nullptr): taken for a null pointer
};

struct Place {
  double latitude_rad = 0.0;   // positive north
  double longitude_rad = 0.0;  // positive east
  double altitude_m = 0.0;     // above the ellipsoid
};

// The air that refracts light near the horizon.
struct Air {
  double pressure_hpa = 1013.25;
  double temperature_c = 15.0;
};

// Returns the unit vector towards the sun in the scene's axes (X south, Y up, Z west):
// (-cos el cos az, sin el, -cos el sin az). Components that are zero up to rounding are exactly zero.
[[nodiscard]] glm::dvec3 direction_to_sun(const SunPosition& sun);

// Returns the topocentric true position of the sun's centre, without refraction, azimuth in 0..2 pi. Valid for years 1900 to
// 2100; throws Error (input) for a time that does not exist or lies outside. Latitude lies in -pi/2..pi/2. `delta_t_s` is
// terrestrial time minus universal time; its default is default_delta_t_s(time). UT1 is taken as UTC, which is off by at
// most 0.9 s, or 0.004 degrees.
[[nodiscard]] SunPosition sun_position(const UtcTime& time, const Place& place, std::optional<double> delta_t_s = {});

// Returns the local hour angle that belongs to sun_position: 0 at transit, positive afterwards, -pi..pi.
[[nodiscard]] double sun_hour_angle_rad(const UtcTime& time, const Place& place);

// Returns terrestrial minus universal time: from 1972 by the leap seconds known to ERFA (the last one is kept for later
// years), before 1972 by the polynomials of Espenak and Meeus (2006).
[[nodiscard]] double default_delta_t_s(const UtcTime& time);

// Returns the elevation as seen through the air: Reda and Andreas (2004), eq. 42. Their refraction holds down to the
// elevation at which the upper limb of the refracted sun touches the horizon (0.8333 degrees below it); further down the
// true elevation is returned.
[[nodiscard]] double apparent_elevation_rad(double true_elevation_rad, const Air& air);

// Returns the time `seconds` later (earlier if negative), in days of 86400 s. Throws Error (input) for invalid times.
[[nodiscard]] UtcTime plus_seconds(const UtcTime& time, double seconds);

// Returns local time with its offset from UTC, such as 2002-08-08T05:00:00+08:00.
[[nodiscard]] std::string local_time_text(const UtcTime& time, int offset_minutes);

// Returns time - origin in seconds, in days of 86400 s.
[[nodiscard]] double seconds_between(const UtcTime& origin, const UtcTime& time);

}  // namespace sunfleck

#pragma once
// Where the sun stands, from angles or from date, time and place.

#include <glm/vec3.hpp>
#include <optional>

namespace sunfleck {

// Azimuth clockwise from north, elevation from the horizon, true (without refraction) unless said otherwise.
struct SunPosition {
  double elevation_rad = 0.0;
  double azimuth_rad = 0.0;
};

// Coordinated universal time, proleptic Gregorian calendar. A leap second is second 60.
struct UtcTime {
  int year = 2000;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  double second = 0.0;
};

struct Place {
  double latitude_rad = 0.0;   // positive north
  double longitude_rad = 0.0;  // positive east
  double altitude_m = 0.0;     // above the ellipsoid
};

// The air that bends the light near the horizon.
struct Air {
  double pressure_hpa = 1013.25;
  double temperature_c = 15.0;
};

// Unit vector towards the sun in the scene's axes (X south, Y up, Z west):
// (-cos el cos az, sin el, -cos el sin az). Components that are zero up to rounding are exactly zero.
[[nodiscard]] glm::dvec3 direction_to_sun(const SunPosition& sun);

// Topocentric true position of the sun's centre, without refraction, azimuth in 0..2 pi. Years 1900 to 2100; a time that
// does not exist or lies outside is an Error of kind input. Latitude in -pi/2..pi/2. `delta_t_s` is terrestrial time minus
// universal time; left out, it is default_delta_t_s(time). UT1 is taken as UTC: at most 0.9 s, or 0.004 degrees, off.
[[nodiscard]] SunPosition sun_position(const UtcTime& time, const Place& place, std::optional<double> delta_t_s = {});

// The local hour angle that belongs to sun_position: 0 at transit, positive afterwards, -pi..pi.
[[nodiscard]] double sun_hour_angle_rad(const UtcTime& time, const Place& place, std::optional<double> delta_t_s = {});

// Terrestrial minus universal time: from 1972 by the leap seconds known to ERFA (the last of them kept for ever), before
// by the polynomials of Espenak and Meeus (2006).
[[nodiscard]] double default_delta_t_s(const UtcTime& time);

// The elevation as seen through the air: Reda and Andreas (2004), eq. 42, whose refraction holds down to where the upper
// limb of a refracted sun is on the horizon (0.8333 degrees below it); the true elevation itself further down.
[[nodiscard]] double apparent_elevation_rad(double true_elevation_rad, const Air& air);

// The time so many seconds later (earlier where negative), in days of 86400 s. Invalid times: Error of kind input.
[[nodiscard]] UtcTime plus_seconds(const UtcTime& time, double seconds);

// time - origin in seconds, in days of 86400 s.
[[nodiscard]] double seconds_between(const UtcTime& origin, const UtcTime& time);

}  // namespace sunfleck

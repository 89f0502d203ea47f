#pragma once
// Conversion of measured or modelled broadband irradiance to beam and sky light.

#include "physics/light/sun.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Broadband (shortwave) irradiance at one moment, W m-2. With the sun's true elevation, global = direct_normal *
// sin(elevation) + diffuse. The beam of a sun at or below the horizon reaches no level ground.
struct Broadband {
  double direct_normal_w_m2 = 0.0;
  double diffuse_w_m2 = 0.0;  // on a horizontal plane

  [[nodiscard]] double direct_horizontal_w_m2(const SunPosition& sun) const;
  [[nodiscard]] double global_w_m2(const SunPosition& sun) const;
};

// Rules for splitting a measured global irradiance. Both use the true elevation, without refraction.
enum class SplitRule { spitters, erbs };

// Returns the day of the year, 1 to 366. In the functions below, an empty day stands for the sun's mean distance.
[[nodiscard]] int day_of_year(const UtcTime& time);

// Returns the irradiance outside the atmosphere on a plane that faces the sun: solar_constant_w_m2 * (1 + 0.033 cos(2 pi day
// / 365)), as in Spitters et al. 1986 and Duffie and Beckman 1980, eq. 1.4.1.
[[nodiscard]] double extraterrestrial_normal_w_m2(double solar_constant_w_m2, std::optional<int> day);

// Returns the diffuse share of the global irradiance, 0..1: Spitters, Toussaint and Goudriaan 1986 (hourly relation), with
// the solar constant 1370 W m-2; 1 with the sun at or below the horizon.
[[nodiscard]] double spitters_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day);

// Returns the same by Erbs, Klein and Duffie 1982, eq. 1, with the solar constant 1367 W m-2.
[[nodiscard]] double erbs_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day);

// Splits a global irradiance. The parts are never negative; everything is diffuse with the sun at or below the horizon. The
// relations were fitted to hours with the sun well up; where they would make the beam stronger than outside the atmosphere,
// the excess counts as diffuse.
[[nodiscard]] Broadband split_global(double global_w_m2, SplitRule rule, const SunPosition& sun, std::optional<int> day);

// Returns the parts where the diffuse irradiance was measured beside the global one: the beam brings the rest, but no more than
// outside the atmosphere (1367 W m-2 on a plane that faces the sun); the excess counts as diffuse. The parts are never negative.
[[nodiscard]] Broadband without_diffuse(double global_w_m2, double diffuse_w_m2, const SunPosition& sun,
                                        std::optional<int> day);

// Clear air. Linke turbidity at air mass 2, at least 1.
struct ClearAir {
  double linke_turbidity = 3.0;
  double altitude_m = 0.0;  // above sea level
};

// Returns clear-sky irradiance after Ineichen and Perez 2002, without Perez enhancement, from the model's own quantities:
// the zenith angle at which the sun is seen through the air, the absolute (pressure-corrected) air mass and the irradiance
// outside the atmosphere. The parts add up with that zenith angle. Zero unless it is below pi / 2. Above about 4000 m, far
// above the stations to which the model was fitted, it can give more light than the sun sends: global irradiance is at most
// that on level ground outside the atmosphere, which keeps the beam, too, below the one there.
[[nodiscard]] Broadband ineichen_perez(const ClearAir& air, double apparent_zenith_rad, double air_mass,
                                       double extraterrestrial_normal_w_m2);

// Returns the same for a true position of the sun: refraction by apparent_elevation_rad, relative air mass by Kasten and
// Young 1989 at the apparent elevation, pressure of the standard atmosphere at the altitude, solar constant 1367 W m-2. The
// parts add up with the true elevation. Zero with the sun at or below the horizon.
[[nodiscard]] Broadband clear_sky(const ClearAir& air, const SunPosition& sun, std::optional<int> day);

// Returns the relative optical air mass (Kasten and Young 1989), for apparent elevations from 0.
[[nodiscard]] double relative_air_mass(double apparent_elevation_rad);

// Returns the pressure of the standard atmosphere (ISO 2533) at altitudes up to 11 km, hPa.
[[nodiscard]] double standard_pressure_hpa(double altitude_m);

// The irradiance measured in the interval [start, start + length_s). If all three values are missing it is a gap of that
// length.
struct WeatherInterval {
  UtcTime start;
  double length_s = 3600.0;
  double ghi_w_m2 = -1.0;  // negative: not measured
  double dni_w_m2 = -1.0;  // with dhi it takes precedence over ghi
  double dhi_w_m2 = -1.0;
  std::size_t line = 0;  // in the file, for messages

  [[nodiscard]] bool has_parts() const { return dni_w_m2 >= 0.0 && dhi_w_m2 >= 0.0; }
};

// The weather of a scene: one moment, the intervals of a file in ascending order, or a clear sky.
struct Weather {
  enum class Source { moment, intervals, clear_sky };
  Source source = Source::moment;
  WeatherInterval moment;                  // for Source::moment; its times mean nothing
  std::vector<WeatherInterval> intervals;  // for Source::intervals
  std::string name;                        // name of their file, for messages

  int zone_minutes = 0;  // local time of the file minus UTC

  // A typical year: the intervals cover one whole calendar year of local time and apply to every year.
  bool every_year = false;

  SplitRule split = SplitRule::spitters;
  ClearAir air;  // for Source::clear_sky
};

// Returns the interval that holds a time. Throws Error (input), naming the time, if there is none.
[[nodiscard]] const WeatherInterval& interval_at(const Weather& weather, const UtcTime& time);

// Returns the broadband irradiance at a moment; the time may be empty unless the source is intervals. Throws Error (input),
// naming the time, if no interval holds it or nothing was measured in the interval that does.
[[nodiscard]] Broadband weather_at(const Weather& weather, const std::optional<UtcTime>& time, const SunPosition& sun);

// Returns the irradiance of a step of this length, with the sun of its middle as given: that of the interval of a file that
// holds all of the step, or else the mean over all intervals that the step overlaps, each weighted by how long it does; what
// was not measured is left out. Throws as weather_at does for the middle.
[[nodiscard]] Broadband weather_of_step(const Weather& weather, const UtcTime& middle, double length_s, const SunPosition& sun);

}  // namespace sunfleck

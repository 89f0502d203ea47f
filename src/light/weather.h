#pragma once
// From measured or modelled broadband irradiance to beam and sky light.

#include "light/sun.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Broadband (shortwave) irradiance of one moment, W m-2. Both parts follow from each other with the sun's true elevation:
// global = direct_normal * sin(elevation) + diffuse. The beam of a sun at or below the horizon reaches no level ground.
struct Broadband {
  double direct_normal_w_m2 = 0.0;
  double diffuse_w_m2 = 0.0;  // on a horizontal plane

  [[nodiscard]] double direct_horizontal_w_m2(const SunPosition& sun) const;
  [[nodiscard]] double global_w_m2(const SunPosition& sun) const;
};

// How a measured global irradiance is split. Both use the true elevation, without refraction.
enum class SplitRule { spitters, erbs };

// Day of the year, 1 to 366. Below, an empty day stands for the sun's mean distance.
[[nodiscard]] int day_of_year(const UtcTime& time);

// Irradiance outside the atmosphere on a plane that faces the sun: solar_constant_w_m2 * (1 + 0.033 cos(2 pi day / 365)), as in
// Spitters et al. 1986 and Duffie and Beckman 1980, eq. 1.4.1.
[[nodiscard]] double extraterrestrial_normal_w_m2(double solar_constant_w_m2, std::optional<int> day);

// Share of the global irradiance that is diffuse, 0..1: Spitters, Toussaint and Goudriaan 1986 (hourly relation), with the
// solar constant 1370 W m-2; 1 with the sun at or below the horizon.
[[nodiscard]] double spitters_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day);

// The same by Erbs, Klein and Duffie 1982, eq. 1, with the solar constant 1367 W m-2.
[[nodiscard]] double erbs_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day);

// Never negative; everything is diffuse with the sun at or below the horizon. The relations stem from hours with the sun well
// up; where they would make the beam stronger than outside the atmosphere, the rest of it is diffuse.
[[nodiscard]] Broadband split_global(double global_w_m2, SplitRule rule, const SunPosition& sun, std::optional<int> day);

// Clear air. Linke turbidity at air mass 2, at least 1.
struct ClearAir {
  double linke_turbidity = 3.0;
  double altitude_m = 0.0;  // above sea level
};

// Ineichen and Perez 2002, without Perez enhancement, from its own quantities: the zenith angle that the sun is seen at through
// the air, the absolute (pressure-corrected) air mass and the irradiance outside the atmosphere. The parts add up with that
// zenith angle. Zero where it is not below pi / 2.
[[nodiscard]] Broadband ineichen_perez(const ClearAir& air, double apparent_zenith_rad, double air_mass,
                                       double extraterrestrial_normal_w_m2);

// The same for a true position of the sun: refraction by apparent_elevation_rad, relative air mass by Kasten and Young 1989 at
// the apparent elevation, pressure of the standard atmosphere at the altitude, solar constant 1367 W m-2. The parts add up with
// the true elevation. Zero with the sun at or below the horizon.
[[nodiscard]] Broadband clear_sky(const ClearAir& air, const SunPosition& sun, std::optional<int> day);

// Relative optical air mass (Kasten and Young 1989), for apparent elevations from 0.
[[nodiscard]] double relative_air_mass(double apparent_elevation_rad);

// Pressure of the standard atmosphere (ISO 2533) at altitudes up to 11 km, hPa.
[[nodiscard]] double standard_pressure_hpa(double altitude_m);

// A measured interval: [start, start + length_s). Where all three are missing there is a gap of that length.
struct WeatherInterval {
  UtcTime start;
  double length_s = 3600.0;
  double ghi_w_m2 = -1.0;  // < 0: not measured
  double dni_w_m2 = -1.0;  // dni and dhi come together, and go before ghi
  double dhi_w_m2 = -1.0;
  std::size_t line = 0;  // of the file, for messages

  [[nodiscard]] bool has_parts() const { return dni_w_m2 >= 0.0 && dhi_w_m2 >= 0.0; }
};

// Weather of a scene: one moment, a file's intervals in ascending order, or a clear sky.
struct Weather {
  enum class Source { moment, intervals, clear_sky };
  Source source = Source::moment;
  WeatherInterval moment;                  // of Source::moment; its times mean nothing
  std::vector<WeatherInterval> intervals;  // of Source::intervals
  std::string name;                        // of their file, for messages

  // A typical year: the intervals, a whole year of one calendar, hold in every year. `zone_minutes` is the distance from UTC of
  // its local standard time, in which its 29 February counts.
  bool every_year = false;
  int zone_minutes = 0;

  SplitRule split = SplitRule::spitters;
  ClearAir air;  // of Source::clear_sky
};

// The interval that holds a time. Throws Error (input), naming the time, if there is none.
[[nodiscard]] const WeatherInterval& interval_at(const Weather& weather, const UtcTime& time);

// The broadband irradiance at a moment; the time may be empty unless the source is intervals. Throws Error (input), naming the
// time, if no interval holds it or nothing was measured in the one that does.
[[nodiscard]] Broadband weather_at(const Weather& weather, const std::optional<UtcTime>& time, const SunPosition& sun);

}  // namespace sunfleck

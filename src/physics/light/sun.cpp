#include "physics/light/sun.h"

#include <erfa.h>
#include <erfam.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/check.h"
#include "base/error.h"
#include "base/units.h"
#include "physics/light/years.h"

namespace sunfleck {
namespace {

constexpr double seconds_per_day = 86400.0;

// A Julian date in two parts, as ERFA expects it: midnight, and the fraction of the day.
struct JulianDate {
  double midnight = 0.0;
  double fraction = 0.0;
};

std::string moment_text(const UtcTime& t) {
  return fmt::format("time {:04}-{:02}-{:02} {:02}:{:02}:{:04.1f} UTC", t.year, t.month, t.day, t.hour, t.minute, t.second);
}

void refuse_year_outside(const UtcTime& time, int first, int last) {
  if (time.year >= first && time.year <= last) return;
  throw_input(moment_text(time), fmt::format("the sun's position is known for {}..{}", first_year, last_year),
              "give a year between them");
}

double seconds_from_midnight(const UtcTime& time) {
  return time.hour * 3600.0 + time.minute * 60.0 + time.second;
}

JulianDate julian_date(const UtcTime& time) {
  refuse_year_outside(time, first_year - 1, last_year + 1);
  double origin = 0.0, days = 0.0;
  if (eraCal2jd(time.year, time.month, time.day, &origin, &days) != 0)
    throw_input(moment_text(time), "no such date in the calendar", "give month 1..12 and a day that month has");
  if (time.hour < 0 || time.hour > 23 || time.minute < 0 || time.minute > 59 || !(time.second >= 0.0 && time.second < 61.0))
    throw_input(moment_text(time), "no such time of day", "give hour 0..23, minute 0..59, second 0..60");
  return {origin + days, seconds_from_midnight(time) / seconds_per_day};
}

// Returns terrestrial minus universal time by the polynomials for 1900 to 1986 of Espenak and Meeus (2006), "Five millennium
// canon of solar eclipses".
double early_delta_t_s(double year) {
  if (year < 1920.0) {
    const double t = year - 1900.0;
    return -2.79 + t * (1.494119 + t * (-0.0598939 + t * (0.0061966 - t * 0.000197)));
  }
  if (year < 1941.0) {
    const double t = year - 1920.0;
    return 21.20 + t * (0.84493 + t * (-0.076100 + t * 0.0020936));
  }
  if (year < 1961.0) {
    const double t = year - 1950.0;
    return 29.07 + t * (0.407 + t * (-1.0 / 233.0 + t / 2547.0));
  }
  const double t = year - 1975.0;
  return 45.45 + t * (1.067 + t * (-1.0 / 260.0 - t / 718.0));
}

struct Observed {
  SunPosition position;
  double hour_angle_rad = 0.0;
};

// Returns earth and observer at the instant, without refraction and polar motion (below 0.5"), as in eraApco13 with TT and
// UT1 given.
eraASTROM observe(const JulianDate& universal, const JulianDate& terrestrial, const Place& place, double heliocentric[2][3],
                  double barycentric[2][3]) {
  eraEpv00(terrestrial.midnight, terrestrial.fraction, heliocentric, barycentric);
  double matrix[3][3], pole_x = 0.0, pole_y = 0.0;
  eraPnm06a(terrestrial.midnight, terrestrial.fraction, matrix);
  eraBpn2xy(matrix, &pole_x, &pole_y);
  const double locator = eraS06(terrestrial.midnight, terrestrial.fraction, pole_x, pole_y);
  const double rotation = eraEra00(universal.midnight, universal.fraction);
  const double terrestrial_locator = eraSp00(terrestrial.midnight, terrestrial.fraction);
  eraASTROM astrom;
  eraApco(terrestrial.midnight, terrestrial.fraction, barycentric, heliocentric[0], pole_x, pole_y, locator, rotation,
          place.longitude_rad, place.latitude_rad, place.altitude_m, 0.0, 0.0, terrestrial_locator, 0.0, 0.0, &astrom);
  return astrom;
}

Observed observed_sun(const UtcTime& time, const Place& place, std::optional<double> delta_t_s) {
  EXPECT(std::abs(place.latitude_rad), <=, std::numbers::pi / 2.0);
  EXPECT(std::abs(place.longitude_rad), <=, 2.0 * std::numbers::pi);
  refuse_year_outside(time, first_year, last_year);
  const JulianDate universal = julian_date(time);
  const double delta_t = delta_t_s ? *delta_t_s : default_delta_t_s(time);
  const JulianDate terrestrial{universal.midnight, universal.fraction + delta_t / seconds_per_day};
  double heliocentric[2][3], barycentric[2][3];
  eraASTROM astrom = observe(universal, terrestrial, place, heliocentric, barycentric);

  // Barycentric position of the sun at the time when the light left it, seen from the observer, in astronomical units.
  const double light_time_days = astrom.em * ERFA_AULT / seconds_per_day;
  double to_sun[3];
  for (int i = 0; i < 3; ++i) {
    const double sun = barycentric[0][i] - heliocentric[0][i];
    const double sun_per_day = barycentric[1][i] - heliocentric[1][i];
    to_sun[i] = sun - sun_per_day * light_time_days - astrom.eb[i];
  }
  double distance_au = 0.0, natural[3], proper[3], intermediate[3];
  eraPn(to_sun, &distance_au, natural);
  eraAb(natural, astrom.v, astrom.em, astrom.bm1, proper);
  eraRxp(astrom.bpn, proper, intermediate);
  double right_ascension = 0.0, declination = 0.0;
  eraC2s(intermediate, &right_ascension, &declination);
  double azimuth = 0.0, zenith = 0.0, hour_angle = 0.0, observed_declination = 0.0, observed_ascension = 0.0;
  eraAtioq(right_ascension, declination, &astrom, &azimuth, &zenith, &hour_angle, &observed_declination, &observed_ascension);
  return {{std::numbers::pi / 2.0 - zenith, azimuth}, hour_angle};
}

}  // namespace

glm::dvec3 direction_to_sun(const SunPosition& sun) {
  const double horizontal = std::cos(sun.elevation_rad);
  glm::dvec3 direction(-horizontal * std::cos(sun.azimuth_rad), std::sin(sun.elevation_rad),
                       -horizontal * std::sin(sun.azimuth_rad));
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) < 1e-15) direction[axis] = 0.0;  // angles near pi leave a few rounding errors
  return direction;
}

SunPosition sun_position(const UtcTime& time, const Place& place, std::optional<double> delta_t_s) {
  return observed_sun(time, place, delta_t_s).position;
}

double sun_hour_angle_rad(const UtcTime& time, const Place& place) {
  return observed_sun(time, place, {}).hour_angle_rad;
}

double default_delta_t_s(const UtcTime& time) {
  const JulianDate date = julian_date(time);
  if (time.year < 1972) return early_delta_t_s(time.year + (time.month - 0.5) / 12.0);
  double atomic_minus_utc_s = 0.0;
  const int status = eraDat(time.year, time.month, time.day, date.fraction < 1.0 ? date.fraction : 1.0, &atomic_minus_utc_s);
  ENSURE(status, >=, 0);  // 1 warns of a year beyond the table, for which the last leap second is kept
  return atomic_minus_utc_s + ERFA_TTMTAI;
}

double apparent_elevation_rad(double true_elevation_rad, const Air& air) {
  constexpr double semi_diameter_deg = 0.26667, horizon_refraction_deg = 0.5667;
  const double elevation_deg = true_elevation_rad / degree;
  if (elevation_deg < -(semi_diameter_deg + horizon_refraction_deg)) return true_elevation_rad;
  const double cotangent_angle_deg = elevation_deg + 10.3 / (elevation_deg + 5.11);
  const double refraction_deg =
      air.pressure_hpa / 1010.0 * 283.0 / (273.0 + air.temperature_c) * 1.02 / (60.0 * std::tan(cotangent_angle_deg * degree));
  return true_elevation_rad + refraction_deg * degree;
}

UtcTime plus_seconds(const UtcTime& time, double seconds) {
  const JulianDate date = julian_date(time);
  const double from_midnight = seconds_from_midnight(time) + seconds;
  const double days = std::floor(from_midnight / seconds_per_day);
  double rest = from_midnight - days * seconds_per_day;
  UtcTime later;
  double fraction = 0.0;
  const int status = eraJd2cal(date.midnight + days, 0.0, &later.year, &later.month, &later.day, &fraction);
  ENSURE(status, ==, 0);
  later.hour = static_cast<int>(rest / 3600.0);
  rest -= later.hour * 3600.0;
  later.minute = static_cast<int>(rest / 60.0);
  later.second = rest - later.minute * 60.0;
  return later;
}

std::string local_time_text(const UtcTime& time, int offset_minutes) {
  const UtcTime local = plus_seconds(time, 60.0 * offset_minutes);
  const int off = std::abs(offset_minutes);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}", local.year, local.month, local.day, local.hour,
                     local.minute, static_cast<int>(local.second), offset_minutes < 0 ? '-' : '+', off / 60, off % 60);
}

double seconds_between(const UtcTime& origin, const UtcTime& time) {
  const double days = julian_date(time).midnight - julian_date(origin).midnight;
  return days * seconds_per_day + (seconds_from_midnight(time) - seconds_from_midnight(origin));
}

}  // namespace sunfleck

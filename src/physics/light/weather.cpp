#include "physics/light/weather.h"

#include "base/check.h"
#include "base/error.h"
#include "base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace sunfleck {

namespace {

using std::numbers::pi;
constexpr double spitters_solar_constant_w_m2 = 1370.0;  // Spitters et al. 1986, eq. 1
constexpr double wrc_solar_constant_w_m2 = 1367.0;       // World Radiometric Centre, as in Duffie and Beckman 1980
constexpr double sea_level_pressure_hpa = 1013.25;       // ISO 2533

// Returns the time as the weather's file states it.
std::string text_of(const Weather& weather, const UtcTime& time) {
  return local_time_text(time, weather.zone_minutes);
}

// Returns the clearness index, the ratio of global irradiance to that outside the atmosphere, for a sun above the horizon.
double clearness(double global_w_m2, double solar_constant, const SunPosition& sun, std::optional<int> day) {
  return global_w_m2 / (extraterrestrial_normal_w_m2(solar_constant, day) * std::sin(sun.elevation_rad));
}

Broadband with_direct(double global_w_m2, double direct_horizontal_w_m2, const SunPosition& sun) {
  const double sine = std::sin(sun.elevation_rad);
  return {direct_horizontal_w_m2 / sine, std::max(0.0, global_w_m2 - direct_horizontal_w_m2)};
}

// Returns the same with no more direct irradiance than there is outside the atmosphere, and never less than none.
Broadband with_possible_direct(double global_w_m2, double direct_horizontal_w_m2, double outside_normal_w_m2,
                               const SunPosition& sun) {
  const double most_w_m2 = outside_normal_w_m2 * std::sin(sun.elevation_rad);
  return with_direct(global_w_m2, std::clamp(direct_horizontal_w_m2, 0.0, most_w_m2), sun);
}

// Returns the time in the year that represents every year. Where that has no 29 February, the day before stands for it.
UtcTime in_typical_year(const Weather& weather, const UtcTime& time) {
  UtcTime local = plus_seconds(time, 60.0 * weather.zone_minutes);
  const UtcTime first = plus_seconds(weather.intervals.front().start, 60.0 * weather.zone_minutes);
  if (local.month == 2 && local.day == 29 && !std::chrono::year(first.year).is_leap()) local.day = 28;
  local.year = first.year;
  return plus_seconds(local, -60.0 * weather.zone_minutes);
}

// Returns the time in the file that stands for a time.
UtcTime time_in_file(const Weather& weather, const UtcTime& time) {
  return weather.every_year ? in_typical_year(weather, time) : time;
}

// Returns the first interval that begins after a time.
std::vector<WeatherInterval>::const_iterator first_after(const Weather& weather, const UtcTime& time) {
  return std::upper_bound(weather.intervals.begin(), weather.intervals.end(), time,
                          [](const UtcTime& t, const WeatherInterval& each) { return t < each.start; });
}

[[noreturn]] void refuse_time(const Weather& weather, const UtcTime& time) {
  std::string why = "the file is empty";
  if (!weather.intervals.empty()) {
    const auto end_of = [](const WeatherInterval& interval) { return plus_seconds(interval.start, interval.length_s); };
    const auto next = first_after(weather, time_in_file(weather, time));
    const bool within = next != weather.intervals.begin() && next != weather.intervals.end();
    why = within ? fmt::format("{} has a gap there: nothing from {} to {}", weather.name,
                               text_of(weather, end_of(*std::prev(next))), text_of(weather, next->start))
                 : fmt::format("{} covers {} to {}", weather.name, text_of(weather, weather.intervals.front().start),
                               text_of(weather, end_of(weather.intervals.back())));
  }
  throw_input("weather at " + text_of(weather, time), why, "choose a time that it covers, or add what is missing");
}

// Returns nothing if nothing was measured in the interval.
std::optional<Broadband> measured_in(const WeatherInterval& interval, SplitRule rule, const SunPosition& sun,
                                     std::optional<int> day) {
  if (interval.has_parts()) return Broadband{interval.dni_w_m2, interval.dhi_w_m2};
  if (interval.ghi_w_m2 < 0.0) return std::nullopt;
  if (interval.dhi_w_m2 >= 0.0) return without_diffuse(interval.ghi_w_m2, interval.dhi_w_m2, sun, day);
  return split_global(interval.ghi_w_m2, rule, sun, day);
}

}  // namespace

double Broadband::direct_horizontal_w_m2(const SunPosition& sun) const {
  return sun.elevation_rad > 0.0 ? direct_normal_w_m2 * std::sin(sun.elevation_rad) : 0.0;
}

double Broadband::global_w_m2(const SunPosition& sun) const {
  return direct_horizontal_w_m2(sun) + diffuse_w_m2;
}

int day_of_year(const UtcTime& time) {
  EXPECT(time.month, >=, 1);
  EXPECT(time.month, <=, 12);
  const std::chrono::year year(time.year);
  const std::chrono::sys_days date(year / time.month / time.day), first(year / 1 / 1);
  return static_cast<int>((date - first).count()) + 1;
}

double extraterrestrial_normal_w_m2(double constant_w_m2, std::optional<int> day) {
  return day ? constant_w_m2 * (1.0 + 0.033 * std::cos(2.0 * pi * *day / 365.0)) : constant_w_m2;
}

double spitters_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day) {
  if (sun.elevation_rad <= 0.0) return 1.0;
  const double sine = std::sin(sun.elevation_rad);
  const double t = clearness(global_w_m2, spitters_solar_constant_w_m2, sun, day);
  const double r = 0.847 - 1.61 * sine + 1.04 * sine * sine;
  const double k = (1.47 - r) / 1.66;
  if (t <= 0.22) return 1.0;
  if (t <= 0.35) return 1.0 - 6.4 * (t - 0.22) * (t - 0.22);
  return t <= k ? 1.47 - 1.66 * t : r;
}

double erbs_diffuse_share(double global_w_m2, const SunPosition& sun, std::optional<int> day) {
  if (sun.elevation_rad <= 0.0) return 1.0;
  const double k = clearness(global_w_m2, wrc_solar_constant_w_m2, sun, day);
  if (k <= 0.22) return 1.0 - 0.09 * k;
  if (k > 0.8) return 0.165;
  return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

Broadband split_global(double global_w_m2, SplitRule rule, const SunPosition& sun, std::optional<int> day) {
  EXPECT(global_w_m2, >=, 0.0);
  if (sun.elevation_rad <= 0.0) return {0.0, global_w_m2};
  const bool spitters = rule == SplitRule::spitters;
  const double share = spitters ? spitters_diffuse_share(global_w_m2, sun, day) : erbs_diffuse_share(global_w_m2, sun, day);
  const double outside_w_m2 =
      extraterrestrial_normal_w_m2(spitters ? spitters_solar_constant_w_m2 : wrc_solar_constant_w_m2, day);
  return with_possible_direct(global_w_m2, (1.0 - share) * global_w_m2, outside_w_m2, sun);
}

Broadband without_diffuse(double global_w_m2, double diffuse_w_m2, const SunPosition& sun, std::optional<int> day) {
  if (sun.elevation_rad <= 0.0) return {0.0, global_w_m2};
  const double outside_w_m2 = extraterrestrial_normal_w_m2(wrc_solar_constant_w_m2, day);
  return with_possible_direct(global_w_m2, global_w_m2 - diffuse_w_m2, outside_w_m2, sun);
}

Broadband ineichen_perez(const ClearAir& air, double apparent_zenith_rad, double air_mass, double outside_w_m2) {
  EXPECT(air.linke_turbidity, >=, 1.0);
  const double cosine = std::cos(apparent_zenith_rad);
  if (cosine <= 0.0) return {};
  const double turbidity = air.linke_turbidity;
  const double fh1 = std::exp(-air.altitude_m / 8000.0);
  const double fh2 = std::exp(-air.altitude_m / 1250.0);
  const double cg1 = 5.09e-5 * air.altitude_m + 0.868;
  const double cg2 = 3.92e-5 * air.altitude_m + 0.0387;
  const double fitted_w_m2 = cg1 * outside_w_m2 * cosine * std::exp(-cg2 * air_mass * (fh1 + fh2 * (turbidity - 1.0)));
  const double global_w_m2 = std::min(outside_w_m2 * cosine, fitted_w_m2);
  const double b = 0.664 + 0.163 / fh1;
  const double by_turbidity_w_m2 = b * outside_w_m2 * std::exp(-0.09 * air_mass * (turbidity - 1.0));
  const double most_share = 1.0 - (0.1 - 0.2 * std::exp(-turbidity)) / (0.1 + 0.882 / fh1);
  const double direct_normal_w_m2 = std::min(by_turbidity_w_m2, global_w_m2 * most_share / cosine);
  return {direct_normal_w_m2, std::max(0.0, global_w_m2 - direct_normal_w_m2 * cosine)};
}

double relative_air_mass(double apparent_elevation_rad) {
  const double elevation_deg = in_degrees(apparent_elevation_rad);
  return 1.0 / (std::sin(apparent_elevation_rad) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

double standard_pressure_hpa(double altitude_m) {
  return sea_level_pressure_hpa * std::pow(1.0 - 0.0065 / 288.15 * altitude_m, 5.25588);
}

Broadband clear_sky(const ClearAir& air, const SunPosition& sun, std::optional<int> day) {
  if (sun.elevation_rad <= 0.0) return {};
  const double pressure_hpa = standard_pressure_hpa(air.altitude_m);
  const double apparent_rad = std::min(pi / 2.0, apparent_elevation_rad(sun.elevation_rad, {.pressure_hpa = pressure_hpa}));
  const double air_mass = relative_air_mass(apparent_rad) * pressure_hpa / sea_level_pressure_hpa;
  const Broadband seen =
      ineichen_perez(air, pi / 2.0 - apparent_rad, air_mass, extraterrestrial_normal_w_m2(wrc_solar_constant_w_m2, day));
  const double global_w_m2 = seen.global_w_m2({apparent_rad, sun.azimuth_rad});
  return with_direct(global_w_m2, std::min(global_w_m2, seen.direct_horizontal_w_m2(sun)), sun);
}

const WeatherInterval& interval_at(const Weather& weather, const UtcTime& time) {
  if (weather.intervals.empty()) refuse_time(weather, time);
  const UtcTime asked = time_in_file(weather, time);
  const auto next = first_after(weather, asked);
  if (next == weather.intervals.begin()) refuse_time(weather, time);
  const WeatherInterval& interval = *std::prev(next);
  if (seconds_between(interval.start, asked) >= interval.length_s) refuse_time(weather, time);
  return interval;
}

Broadband weather_at(const Weather& weather, const std::optional<UtcTime>& time, const SunPosition& sun) {
  const std::optional<int> day = time ? std::optional<int>(day_of_year(*time)) : std::nullopt;
  if (weather.source == Weather::Source::clear_sky) return clear_sky(weather.air, sun, day);
  if (weather.source == Weather::Source::intervals) EXPECT(time.has_value(), ==, true);
  const WeatherInterval& given = weather.source == Weather::Source::moment ? weather.moment : interval_at(weather, *time);
  if (const auto measured = measured_in(given, weather.split, sun, day)) return *measured;
  EXPECT(weather.source == Weather::Source::intervals, ==, true);
  throw_input(fmt::format("{}:{}: weather at {}", weather.name, given.line, text_of(weather, *time)),
              "irradiance is marked as missing there", "choose another time, or fill the value in");
}

Broadband weather_of_step(const Weather& weather, const UtcTime& middle, double length_s, const SunPosition& sun) {
  constexpr double rounding_s = 1e-3;  // of differences between times
  const Broadband at_middle = weather_at(weather, middle, sun);
  if (weather.source != Weather::Source::intervals) return at_middle;
  const UtcTime begin = plus_seconds(time_in_file(weather, middle), -0.5 * length_s);
  const WeatherInterval& around = interval_at(weather, middle);
  const double into_s = seconds_between(around.start, begin);
  if (into_s >= -rounding_s && into_s + length_s <= around.length_s + rounding_s) return at_middle;
  auto interval = first_after(weather, begin);
  if (interval != weather.intervals.begin()) --interval;
  const int day = day_of_year(middle);
  Broadband sum;
  double measured_s = 0.0;
  for (; interval != weather.intervals.end(); ++interval) {
    const double start_s = seconds_between(begin, interval->start);
    if (start_s >= length_s) break;
    const double within_s = std::min(length_s, start_s + interval->length_s) - std::max(0.0, start_s);
    const std::optional<Broadband> light = measured_in(*interval, weather.split, sun, day);
    if (within_s <= rounding_s || !light) continue;
    sum.direct_normal_w_m2 += within_s * light->direct_normal_w_m2;
    sum.diffuse_w_m2 += within_s * light->diffuse_w_m2;
    measured_s += within_s;
  }
  return {sum.direct_normal_w_m2 / measured_s, sum.diffuse_w_m2 / measured_s};
}

}  // namespace sunfleck

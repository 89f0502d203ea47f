#include "files/scene/weather_plausibility.h"

#include "files/scene/light_plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace sunfleck {
namespace {

constexpr std::size_t most_samples = 1000;
constexpr std::size_t fewest_samples = 12;
constexpr double longest_interval_s = 2.0 * 3600.0;  // longer ones say little about the time of day
constexpr double good_fit = 0.8;
constexpr double better_by = 0.03;  // a sun moved by one hour loses 0.05, by half an hour 0.015
constexpr double least_offset_h = 1.0;
constexpr double least_mean_s = 1800.0;    // light of clouds' edges does not last so long
constexpr double high_sun_sine = 0.34;     // 20 degrees
constexpr double dark_w_m2 = 5.0;          // more comes with a high sun through any cloud
constexpr double night_rad = -0.1047;      // 6 degrees below the horizon: the end of civil twilight
constexpr double night_light_w_m2 = 20.0;  // above the zero error of instruments
constexpr double day_s = 86400.0;

struct Sample {
  const WeatherInterval* interval = nullptr;
  double light_w_m2 = 0.0;
  double declination_rad = 0.0, hour_angle_rad = 0.0;
};

// Returns the measured global irradiance, or a sum of the parts that grows with it.
std::optional<double> light_of(const WeatherInterval& interval) {
  if (interval.ghi_w_m2 >= 0.0) return interval.ghi_w_m2;
  if (interval.has_parts()) return interval.dhi_w_m2 + interval.dni_w_m2;
  return std::nullopt;
}

std::vector<Sample> samples_of(const Weather& weather, const Place& place) {
  std::vector<Sample> samples;
  const auto& all = weather.intervals;
  if (all.empty()) return samples;
  const auto per_day = std::max<std::size_t>(1, static_cast<std::size_t>(day_s / std::max(1.0, all.front().length_s)));
  const std::size_t every = 1 + all.size() / most_samples;
  for (std::size_t i = 0; i < all.size() && samples.size() < most_samples; ++i) {
    const auto light = light_of(all[i]);
    if ((i / per_day) % every != 0 || !light || all[i].length_s > longest_interval_s) continue;
    const UtcTime middle = plus_seconds(all[i].start, 0.5 * all[i].length_s);
    const SunPosition sun = sun_position(middle, place);
    const double sine_lat = std::sin(place.latitude_rad), cosine_lat = std::cos(place.latitude_rad);
    const double level = std::cos(sun.elevation_rad), height = std::sin(sun.elevation_rad);
    const double sine = sine_lat * height + cosine_lat * level * std::cos(sun.azimuth_rad);
    // The components of the direction to the sun in the plane of the equator, to the west and to the meridian.
    const double west = -level * std::sin(sun.azimuth_rad);
    const double meridian = cosine_lat * height - sine_lat * level * std::cos(sun.azimuth_rad);
    samples.push_back({&all[i], *light, std::asin(std::clamp(sine, -1.0, 1.0)), std::atan2(west, meridian)});
  }
  return samples;
}

// Returns the sine of the sun's elevation at a latitude, with its hour angle moved.
double sine_of_elevation(const Sample& sample, double latitude_rad, double moved_rad) {
  return std::sin(latitude_rad) * std::sin(sample.declination_rad) +
         std::cos(latitude_rad) * std::cos(sample.declination_rad) * std::cos(sample.hour_angle_rad + moved_rad);
}

// Returns the correlation of the light with the sine of the sun's elevation, 0 at night, at a latitude and with the hour angle
// moved; 0 if one of them does not vary.
double fit(const std::vector<Sample>& samples, double latitude_rad, double moved_rad) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (const Sample& sample : samples) {
    const double sine = std::max(0.0, sine_of_elevation(sample, latitude_rad, moved_rad));
    n += 1.0;
    x += sine;
    y += sample.light_w_m2;
    xx += sine * sine;
    yy += sample.light_w_m2 * sample.light_w_m2;
    xy += sine * sample.light_w_m2;
  }
  const double spread = (n * xx - x * x) * (n * yy - y * y);
  return spread > 0.0 ? (n * xy - x * y) / std::sqrt(spread) : 0.0;
}

struct BestOffset {
  double hours = 0.0;
  double fit = 0.0;
};

BestOffset best_offset(const std::vector<Sample>& samples, double latitude_rad) {
  BestOffset best;
  for (int half_hours = -24; half_hours < 24; ++half_hours) {
    const double found = fit(samples, latitude_rad, half_hours * std::numbers::pi / 24.0);
    if (found > best.fit) best = {0.5 * half_hours, found};
  }
  return best;
}

// Returns what explains the light better than the place and times as given.
std::optional<std::string> misfit(const std::vector<Sample>& samples, const Place& place, const std::string& where) {
  const double as_given = fit(samples, place.latitude_rad, 0.0);
  const double enough = std::max(good_fit, as_given + better_by);
  const BestOffset best = best_offset(samples, place.latitude_rad);
  const bool swappable = std::abs(place.longitude_rad) <= std::numbers::pi / 2.0;
  const double swapped = swappable ? fit(samples, place.longitude_rad, place.latitude_rad - place.longitude_rad) : 0.0;
  if (swapped >= enough && swapped >= best.fit - better_by) {
    return fmt::format(
        "{}: its light follows the sun of latitude {:.6g}, longitude {:.6g}; the two seem to be exchanged in [sun]", where,
        glm::degrees(place.longitude_rad), glm::degrees(place.latitude_rad));
  }
  if (best.fit < enough || std::abs(best.hours) < least_offset_h) return std::nullopt;
  return fmt::format(
      "{}: its light does not follow the sun, but would if its times were {:.3g} hours {}; check their offset "
      "from UTC and the longitude in [sun]",
      where, std::abs(best.hours), best.hours > 0.0 ? "later" : "earlier");
}

// Returns the light outside the atmosphere on the line of sight.
double outside_w_m2(std::optional<int> day) {
  return extraterrestrial_normal_w_m2(solar_constant_w_m2, day);
}

// Returns which value of an interval is impossible, with its limit. A mean over a long time, unlike a moment, is never more
// than what comes from outside the atmosphere.
std::optional<std::string> excess(const WeatherInterval& interval, double elevation_rad, std::optional<int> day,
                                  bool is_long_mean) {
  const double sine = std::max(0.0, std::sin(elevation_rad));
  const double outside = outside_w_m2(day);
  const double level = outside * std::pow(sine, 1.2);
  const auto over = [](const char* name, double value, double limit) -> std::optional<std::string> {
    if (value <= limit) return std::nullopt;
    return fmt::format("{} = {:.6g} W m-2 is more than the sun can send; at most {:.0f}", name, value, limit);
  };
  if (!interval.has_parts()) {
    auto found = over("ghi", interval.ghi_w_m2, is_long_mean ? outside * sine + 50.0 : 1.5 * level + 100.0);
    if (found && is_long_mean) *found += "; PAR in umol m-2 s-1 is about twice as many as W m-2 of all solar light";
    if (found || interval.dhi_w_m2 <= 1.2 * std::max(0.0, interval.ghi_w_m2) + 20.0) return found;
    return fmt::format("dhi = {:.6g} W m-2 is more than ghi = {:.6g}; diffuse light is part of global irradiance",
                       interval.dhi_w_m2, interval.ghi_w_m2);
  }
  if (auto found = over("dni", interval.dni_w_m2, outside)) return found;
  return over("dhi", interval.dhi_w_m2, 0.95 * level + 50.0);
}

// Returns a warning about intervals that are too long for the sun's course, or light that is too faint for a high sun.
std::optional<std::string> unlikely(const Weather& weather, const std::vector<Sample>& samples, const Place& place,
                                    const std::string& where) {
  constexpr double hour_s = 3600.0;
  if (!weather.intervals.empty() && weather.intervals.front().length_s > longest_interval_s) {
    return fmt::format(
        "{}: its intervals last {:.3g} hours, and all light within one is the same, however high the sun is; give hourly "
        "values",
        where, weather.intervals.front().length_s / hour_s);
  }
  std::size_t high = 0;
  double most_w_m2 = 0.0;
  for (const Sample& sample : samples) {
    if (sine_of_elevation(sample, place.latitude_rad, 0.0) < high_sun_sine) continue;
    ++high;
    most_w_m2 = std::max(most_w_m2, sample.light_w_m2);
  }
  if (high < fewest_samples || most_w_m2 >= dark_w_m2) return std::nullopt;
  return fmt::format(
      "{}: with the sun above 20 degrees it has at most {:.3g} W m-2; values in kW m-2 or MJ m-2 must be converted", where,
      most_w_m2);
}

// Returns the highest elevation in the interval, judged by its ends and its middle.
double highest_rad(const Sample& sample, double latitude_rad) {
  const double half_rad = std::numbers::pi * sample.interval->length_s / day_s;
  double highest = -1.0;
  for (const double moved_rad : {-half_rad, 0.0, half_rad}) {
    highest = std::max(highest, sine_of_elevation(sample, latitude_rad, moved_rad));
  }
  return std::asin(std::min(1.0, highest));
}

}  // namespace

std::vector<std::string> weather_warnings(const Weather& weather, const Place& place, const std::string& where) {
  const std::vector<Sample> samples = samples_of(weather, place);
  std::vector<std::string> warnings;
  if (samples.size() >= fewest_samples) {
    if (auto found = misfit(samples, place, where)) return {*found};
  }
  if (auto found = unlikely(weather, samples, place, where)) return {*found};
  bool at_night = false, too_much = false;
  for (const Sample& sample : samples) {
    if (sample.light_w_m2 <= night_light_w_m2 || (at_night && too_much)) continue;
    const double highest = highest_rad(sample, place.latitude_rad);
    if (!at_night && highest < night_rad) {
      at_night = true;
      warnings.push_back(
          fmt::format("{}: line {} has {:.4g} W m-2 while the sun is {:.3g} degrees below the horizon; it should "
                      "have 0",
                      where, sample.interval->line, sample.light_w_m2, -glm::degrees(highest)));
    } else if (!too_much && highest >= night_rad) {
      const auto found =
          excess(*sample.interval, highest, day_of_year(sample.interval->start), sample.interval->length_s >= least_mean_s);
      too_much = found.has_value();
      if (found) warnings.push_back(fmt::format("{}: in line {}, {}", where, sample.interval->line, *found));
    }
  }
  return warnings;
}

std::vector<std::string> moment_warnings(const WeatherInterval& moment, const SunPosition& sun, std::optional<int> day,
                                         const std::string& where) {
  const auto found = excess(moment, sun.elevation_rad, day, false);
  if (!found) return {};
  return {fmt::format("{}: {}", where, *found)};
}

}  // namespace sunfleck

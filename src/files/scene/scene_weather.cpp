#include "files/scene/scene_weather.h"

#include "files/formats/weather/station_reader.h"
#include "files/formats/weather/weather_reader.h"
#include "files/scene/scene_files.h"
#include "files/scene/weather_plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string_view>
#include <utility>

namespace sunfleck {

namespace {

constexpr double earth_radius_m = 6.371e6;
constexpr double far_m = 100e3;  // the weather of a station farther away causes a warning

constexpr NumberRange broadband{.lo = 0.0, .hi = most_broadband_w_m2, .cure = "give W m-2 of all solar radiation"};

void refuse_with(const TomlTable& table, std::initializer_list<const char*> keys, std::string_view why) {
  for (const char* key : keys) {
    if (table.has(key)) table.refuse(key, why, "remove it");
  }
}

// Returns the great-circle distance.
double distance_m(const Place& a, const Place& b) {
  const double sine_lat = std::sin(0.5 * (a.latitude_rad - b.latitude_rad));
  const double sine_lon = std::sin(0.5 * (a.longitude_rad - b.longitude_rad));
  const double h = sine_lat * sine_lat + std::cos(a.latitude_rad) * std::cos(b.latitude_rad) * sine_lon * sine_lon;
  return 2.0 * earth_radius_m * std::asin(std::min(1.0, std::sqrt(h)));
}

void warn_of_other_place(const TomlTable& table, const WeatherFile& file, const SunMoment& moment,
                         std::vector<std::string>& warnings) {
  if (!file.place) return;
  const double apart_m = distance_m(*file.place, moment.place);
  if (apart_m < far_m) return;
  warnings.push_back(fmt::format("{} was recorded at latitude {:.6g}, longitude {:.6g}, {:.0f} km from the place in [sun]",
                                 table.place("file"), glm::degrees(file.place->latitude_rad),
                                 glm::degrees(file.place->longitude_rad), apart_m / 1000.0));
}

void warn_of_other_year(const TomlTable& table, const WeatherFile& file, const SunMoment& moment,
                        std::vector<std::string>& warnings) {
  if (!file.years) return;
  const UtcTime local = plus_seconds(moment.time, 60.0 * file.weather.zone_minutes);
  const int year = (*file.years)[static_cast<std::size_t>(local.month - 1)];
  if (year == local.year) return;
  warnings.push_back(fmt::format("{} holds month {} of {}, not of {}: hours are looked up by month, day and hour",
                                 table.place("file"), local.month, year, local.year));
}

// Returns the offset of a file's times in minutes, if one is given.
std::optional<int> read_utc_offset(const TomlTable& table) {
  const std::optional<std::string> text = table.text("utc_offset");
  if (!text) return std::nullopt;
  const std::optional<int> minutes = parse_utc_offset(*text);
  if (!minutes) table.refuse("utc_offset", "is not an offset from UTC", "write it as \"+08:00\"");
  return minutes;
}

void read_weather_file(const TomlTable& table, const std::filesystem::path& scene_file, const SceneAccess& access,
                       const SunInput& sun, WeatherInput& input, std::vector<std::string>& warnings) {
  refuse_with(table, {"ghi", "dni", "dhi", "clear_sky"}, "a file is also given, and only one of them can define the weather");
  if (!sun.moment) table.refuse("file", "[sun] has no time to look up in it", "give time, latitude and longitude in [sun]");
  const std::filesystem::path path = find_scene_file(table, scene_file, access, "name a .csv or .epw file");
  if (!is_weather_file(path)) table.refuse("file", "its format is unknown", "use .csv or .epw");
  WeatherFile file = read_weather(path, access.files, read_utc_offset(table));
  warn_of_other_place(table, file, *sun.moment, warnings);
  warn_of_other_year(table, file, *sun.moment, warnings);
  input.weather = std::move(file.weather);
}

void read_clear_sky(const TomlTable& table, WeatherInput& input) {
  static_cast<void>(table.word("clear_sky", {"ineichen"}));  // the only model
  refuse_with(table, {"ghi", "dni", "dhi"}, "clear_sky is also given, and computes the irradiance");
  refuse_with(table, {"split"}, "a clear sky has separate direct and diffuse parts, so there is nothing to split");
  input.weather.source = Weather::Source::clear_sky;
}

void read_moment(const TomlTable& table, WeatherInput& input) {
  WeatherInterval& moment = input.weather.moment;
  if (table.has("ghi")) {
    refuse_with(table, {"dni"}, "ghi is also given, but follows from the parts");
    moment.ghi_w_m2 = *table.number("ghi", broadband);
    if (!table.has("dhi")) return;
    refuse_with(table, {"split"}, "ghi and dhi tell the parts, so there is nothing to split");
    moment.dhi_w_m2 = *table.number("dhi", broadband);
    return;
  }
  if (!table.has("dni") && !table.has("dhi")) {
    table.refuse_table("it has no irradiance", "add ghi, or dni or ghi with dhi, or file, or clear_sky = \"ineichen\"");
  }
  table.require("dni", "dni, the direct normal irradiance in W m-2, or ghi");
  table.require("dhi", "dhi, the diffuse horizontal irradiance in W m-2, or give only ghi");
  refuse_with(table, {"split"}, "dni and dhi already are the parts, so there is nothing to split");
  moment.dni_w_m2 = *table.number("dni", broadband);
  moment.dhi_w_m2 = *table.number("dhi", broadband);
}

void warn_of_unknown_day(const WeatherInput& input, const SunInput& sun, std::vector<std::string>& warnings) {
  if (sun.moment || (input.weather.source == Weather::Source::moment && input.weather.moment.dhi_w_m2 >= 0.0)) return;
  warnings.push_back(
      fmt::format("{}: without a time in [sun] the day of the year is unknown, so the mean distance of the sun is used",
                  input.table.place()));
}

void warn_of_strange_light(const WeatherInput& input, const SunInput& sun, std::vector<std::string>& warnings) {
  std::vector<std::string> found;
  if (input.weather.source == Weather::Source::intervals) {
    found = weather_warnings(input.weather, sun.moment->place, input.table.place("file"));
  } else if (input.weather.source == Weather::Source::moment) {
    const auto day = sun.moment ? std::optional<int>(day_of_year(sun.moment->time)) : std::nullopt;
    found = moment_warnings(input.weather.moment, sun.position, day, input.table.place());
  }
  warnings.insert(warnings.end(), found.begin(), found.end());
}

}  // namespace

bool WeatherInput::may_be_diffuse() const {
  return weather.source != Weather::Source::moment || !weather.moment.has_parts() || weather.moment.dhi_w_m2 > 0.0;
}

std::optional<WeatherInput> read_weather_table(const TomlTable& root, const std::filesystem::path& scene_file,
                                               const SceneAccess& access, const std::optional<SunInput>& sun,
                                               std::vector<std::string>& warnings) {
  const auto table = root.table("weather");
  if (!table) return std::nullopt;
  table->allow({"ghi", "dni", "dhi", "file", "utc_offset", "split", "clear_sky", "linke_turbidity", "altitude"});
  if (!sun) table->refuse_table("its light needs a [sun]", "add [sun]");
  WeatherInput input{.weather = {}, .table = *table};
  if (!table->has("clear_sky")) {
    refuse_with(*table, {"linke_turbidity", "altitude"}, "it is only for clear_sky = \"ineichen\"");
  }
  if (!table->has("file")) refuse_with(*table, {"utc_offset"}, "it is only for the times of a file");
  if (table->has("file")) {
    read_weather_file(*table, scene_file, access, *sun, input, warnings);
  } else if (table->has("clear_sky")) {
    read_clear_sky(*table, input);
  } else {
    read_moment(*table, input);
  }
  if (const auto split = table->word("split", {"spitters", "erbs"})) {
    input.weather.split = *split == 0 ? SplitRule::spitters : SplitRule::erbs;
  }
  ClearAir& air = input.weather.air;
  air.linke_turbidity =
      table->number("linke_turbidity", {.lo = 1.0, .hi = 20.0, .cure = "give 2 for very clean air, 3 for clean, 6 for hazy"})
          .value_or(air.linke_turbidity);
  air.altitude_m =
      table->number("altitude", {.lo = -500.0, .hi = 9000.0, .cure = "give metres above sea level"}).value_or(air.altitude_m);
  warn_of_unknown_day(input, *sun, warnings);
  warn_of_strange_light(input, *sun, warnings);
  return input;
}

}  // namespace sunfleck

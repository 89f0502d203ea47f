// What comes in: [sun] and [[band]].

#include "base/error.h"
#include "io/file.h"
#include "io/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace sunfleck {

namespace {

constexpr double largest_irradiance_w_m2 = 1e15;
constexpr std::size_t most_bands = 1000;
constexpr std::size_t longest_band_name = 64;

// Years (UTC) that sun_position knows.
constexpr int first_year = 1900;
constexpr int last_year = 2100;

UtcTime to_utc(const OffsetTime& written) {
  using namespace std::chrono;
  const sys_days date = year(written.year) / written.month / written.day;
  const sys_time<minutes> instant = date + hours(written.hour) + minutes(written.minute - written.offset_minutes);
  const sys_days utc_date = floor<days>(instant);
  const year_month_day calendar(utc_date);
  const minutes of_day = instant - utc_date;
  return UtcTime{.year = static_cast<int>(calendar.year()),
                 .month = static_cast<int>(static_cast<unsigned>(calendar.month())),
                 .day = static_cast<int>(static_cast<unsigned>(calendar.day())),
                 .hour = static_cast<int>(of_day.count() / 60),
                 .minute = static_cast<int>(of_day.count() % 60),
                 .second = written.second};
}

SunInput read_moment(const TomlTable& sun) {
  for (const char* key : {"elevation", "azimuth"}) {
    if (sun.has(key))
      sun.refuse(key, "the sun is given by time and place already", "remove it, or time, latitude and longitude");
  }
  sun.require("time", "time = 2002-08-08T10:10:00+08:00");
  sun.require("latitude", "latitude in degrees north, as in latitude = 40.02");
  sun.require("longitude", "longitude in degrees east, as in longitude = 116.28");
  const OffsetTime written = *sun.offset_time("time");
  SunMoment moment;
  moment.time = to_utc(written);
  if (moment.time.year < first_year || moment.time.year > last_year) {
    sun.refuse("time", fmt::format("its year in UTC, {}, must lie in {}..{}", moment.time.year, first_year, last_year),
               "correct the year");
  }
  moment.offset_minutes = written.offset_minutes;
  moment.place.latitude_rad = glm::radians(*sun.number("latitude", {.lo = -90.0, .hi = 90.0, .cure = "give degrees north"}));
  moment.place.longitude_rad = glm::radians(
      *sun.number("longitude", {.lo = -180.0, .hi = 360.0, .cure = "give degrees east, negative or above 180 for west"}));
  return {sun_position(moment.time, moment.place), moment, sun};
}

SunInput read_angles(const TomlTable& sun) {
  sun.require("elevation", "elevation in degrees, or all of time, latitude and longitude");
  sun.require("azimuth", "azimuth in degrees clockwise from north, as in azimuth = 120.569");
  const double elevation_deg = *sun.number("elevation", {.lo = -90.0, .hi = 90.0, .cure = "give degrees above the horizon"});
  double azimuth_deg = *sun.number("azimuth", {.lo = -360.0, .hi = 360.0, .cure = "give degrees clockwise from north"});
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  if (azimuth_deg >= 360.0) azimuth_deg -= 360.0;
  return {SunPosition{glm::radians(elevation_deg), glm::radians(azimuth_deg)}, std::nullopt, sun};
}

std::string read_band_name(const TomlTable& band, const std::vector<Waveband>& earlier) {
  band.require("name", "name = \"PAR\"");
  std::string name = *band.text("name");
  const bool usable =
      name.size() <= longest_band_name && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
      });
  if (!usable) {
    band.refuse("name", fmt::format("it heads columns: letters, digits, _ and -, at most {}", longest_band_name),
                "give a name such as PAR or band_1");
  }
  if (std::any_of(earlier.begin(), earlier.end(), [&](const Waveband& other) { return other.name == name; })) {
    band.refuse("name", "another [[band]] has this name", "give every band a name of its own");
  }
  return name;
}

// W m-2 on a horizontal plane.
double read_direct_w_m2(const TomlTable& band, const std::optional<SunInput>& sun) {
  const NumberRange irradiance{.lo = 0.0, .hi = largest_irradiance_w_m2, .cure = "give W m-2"};
  if (band.has("direct") && band.has("direct_normal")) {
    band.refuse("direct_normal", "direct is given too, and either follows from the other", "remove one of the two");
  }
  const char* key = band.has("direct_normal") ? "direct_normal" : "direct";
  const double given_w_m2 = band.number(key, irradiance).value_or(0.0);
  if (given_w_m2 == 0.0) return 0.0;
  if (!sun) band.refuse(key, "there is no [sun] for this light to come from", "add [sun] or remove it");
  const double elevation_rad = sun->position.elevation_rad;
  if (elevation_rad <= 0.0) return 0.0;
  return band.has("direct_normal") ? given_w_m2 * std::sin(elevation_rad) : given_w_m2;
}

void refuse_diffuse(const TomlTable& band) {
  const double diffuse_w_m2 =
      band.number("diffuse", {.lo = 0.0, .hi = largest_irradiance_w_m2, .cure = "give W m-2"}).value_or(0.0);
  if (diffuse_w_m2 > 0.0) band.refuse("diffuse", "sky light is not in this version yet", "remove it or give 0");
}

}  // namespace

void refuse_unsupported(const TomlTable& table, std::string_view key, std::string_view feature) {
  if (table.has(key)) table.refuse(key, fmt::format("{} not in this version yet", feature), "remove it");
}

std::optional<SunInput> read_sun(const TomlTable& root) {
  const auto sun = root.table("sun");
  if (!sun) return std::nullopt;
  sun->allow({"time", "latitude", "longitude", "elevation", "azimuth"});
  const bool by_moment = sun->has("time") || sun->has("latitude") || sun->has("longitude");
  return by_moment ? read_moment(*sun) : read_angles(*sun);
}

std::vector<Waveband> read_bands(const TomlTable& root, const std::optional<SunInput>& sun) {
  const std::vector<TomlTable> tables = root.tables("band");
  if (tables.empty()) root.require("band", "[[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.empty()) root.refuse("band", "there must be at least one", "add [[band]] with name = \"PAR\" and direct = 350.0");
  if (tables.size() > most_bands) root.refuse("band", fmt::format("there may be at most {}", most_bands), "split the scene");
  std::vector<Waveband> bands;
  for (const TomlTable& table : tables) {
    table.allow({"name", "direct", "direct_normal", "diffuse", "share", "umol_per_joule"});
    refuse_unsupported(table, "share", "weather data is");
    refuse_unsupported(table, "umol_per_joule", "photon units are");
    Waveband band;
    band.name = read_band_name(table, bands);
    band.direct_w_m2 = read_direct_w_m2(table, sun);
    refuse_diffuse(table);
    bands.push_back(std::move(band));
  }
  return bands;
}

}  // namespace sunfleck

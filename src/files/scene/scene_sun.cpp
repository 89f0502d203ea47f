#include "files/scene/scene_sun.h"

#include "physics/light/years.h"

#include <fmt/format.h>

#include <chrono>
#include <glm/trigonometric.hpp>

namespace sunfleck {

namespace {

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
    if (sun.has(key)) sun.refuse(key, "time and place already determine the sun", "remove it, or time, latitude and longitude");
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

}  // namespace

std::optional<SunInput> read_sun(const TomlTable& root) {
  const auto sun = root.table("sun");
  if (!sun) return std::nullopt;
  sun->allow({"time", "latitude", "longitude", "elevation", "azimuth"});
  const bool by_moment = sun->has("time") || sun->has("latitude") || sun->has("longitude");
  return by_moment ? read_moment(*sun) : read_angles(*sun);
}

}  // namespace sunfleck

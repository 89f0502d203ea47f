#include "files/scene/weather_plausibility.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sunfleck {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr Place paris{48.85 * degree, 2.35 * degree, 0.0};

// Hours of clear sky from 1 June 2020 in UTC, each at its middle.
Weather clear_hours(int hours, const Place& place, double moved_h = 0.0) {
  Weather weather;
  weather.source = Weather::Source::intervals;
  const UtcTime begin{2020, 6, 1, 0, 0, 0.0};
  for (int hour = 0; hour < hours; ++hour) {
    WeatherInterval interval;
    interval.start = plus_seconds(begin, 3600.0 * hour);
    const SunPosition sun = sun_position(plus_seconds(interval.start, 1800.0 - 3600.0 * moved_h), place);
    interval.ghi_w_m2 = clear_sky({}, sun, 160).global_w_m2(sun);
    interval.line = static_cast<std::size_t>(hour) + 2;
    weather.intervals.push_back(interval);
  }
  return weather;
}

std::string only_warning(const Weather& weather, const Place& place) {
  const auto warnings = weather_warnings(weather, place, "scene.toml:9: weather.file");
  EXPECT_EQ(warnings.size(), 1U);
  return warnings.empty() ? "" : warnings.front();
}

TEST(WeatherPlausibility, WeatherOfThePlaceIsSilent) {
  for (const int hours : {0, 5, 12, 24, 24 * 30, 24 * 200}) {
    EXPECT_TRUE(weather_warnings(clear_hours(hours, paris), paris, "w").empty()) << hours;
  }
  // The middle of an interval is often confused with its end: half an hour is not worth a warning.
  EXPECT_TRUE(weather_warnings(clear_hours(240, paris, 0.5), paris, "w").empty());
}

TEST(WeatherPlausibility, TimesInAnotherZoneAreFound) {
  EXPECT_NE(only_warning(clear_hours(240, paris, 2.0), paris).find("if its times were 2 hours earlier"), std::string::npos);
  EXPECT_NE(only_warning(clear_hours(240, paris, -8.0), paris).find("if its times were 8 hours later"), std::string::npos);
  EXPECT_NE(only_warning(clear_hours(24 * 365, paris, 1.0), paris).find("1 hours earlier"), std::string::npos);
}

TEST(WeatherPlausibility, ExchangedLatitudeAndLongitudeAreFound) {
  const Place exchanged{paris.longitude_rad, paris.latitude_rad, 0.0};
  const std::string warning = only_warning(clear_hours(240, paris), exchanged);
  EXPECT_NE(warning.find("latitude 48.85, longitude 2.35; the two seem to be exchanged"), std::string::npos) << warning;
}

TEST(WeatherPlausibility, NightsAreDark) {
  Weather weather = clear_hours(48, paris);
  weather.intervals[25].ghi_w_m2 = 60.0;  // from 01:00 UTC
  EXPECT_NE(only_warning(weather, paris).find("line 27 has 60 W m-2 while the sun is"), std::string::npos);
  weather.intervals[25].ghi_w_m2 = 5.0;
  EXPECT_TRUE(weather_warnings(weather, paris, "w").empty());
}

TEST(WeatherPlausibility, HoursAreNoBrighterThanWithoutAir) {
  Weather weather = clear_hours(48, paris);
  for (WeatherInterval& interval : weather.intervals) interval.ghi_w_m2 *= 2.06;  // PAR in umol m-2 s-1
  const std::string warning = only_warning(weather, paris);
  EXPECT_NE(warning.find("is more than the sun can send; at most"), std::string::npos) << warning;
  EXPECT_NE(warning.find("PAR in umol m-2 s-1"), std::string::npos) << warning;
  weather = clear_hours(48, paris);
  for (WeatherInterval& interval : weather.intervals) {
    interval.ghi_w_m2 *= 1.3;
    interval.length_s = 60.0;
  }
  EXPECT_TRUE(weather_warnings(weather, paris, "w").empty()) << "edges of clouds brighten minutes";
}

TEST(WeatherPlausibility, UnitsOfEnergyAreNoWatts) {
  Weather weather = clear_hours(48, paris);
  for (WeatherInterval& interval : weather.intervals) interval.ghi_w_m2 *= 3.6e-3;
  EXPECT_NE(only_warning(weather, paris).find("values in kW m-2 or MJ m-2 must be converted"), std::string::npos);
}

TEST(WeatherPlausibility, DaysHaveNoCourse) {
  Weather weather = clear_hours(3, paris);
  for (std::size_t day = 0; day < weather.intervals.size(); ++day) {
    weather.intervals[day].start = {2020, 6, static_cast<int>(day) + 1};
    weather.intervals[day].length_s = 86400.0;
    weather.intervals[day].ghi_w_m2 = 250.0;
  }
  EXPECT_NE(only_warning(weather, paris).find("its intervals last 24 hours"), std::string::npos);
}

TEST(WeatherPlausibility, LightIsAtMostThatOfTheSun) {
  Weather weather = clear_hours(48, paris);
  weather.intervals[12].ghi_w_m2 = 2500.0;
  EXPECT_NE(only_warning(weather, paris).find("in line 14, ghi = 2500 W m-2 is more than the sun can send"), std::string::npos);
  weather.intervals[12].dni_w_m2 = 700.0;
  weather.intervals[12].dhi_w_m2 = 100.0;
  EXPECT_TRUE(weather_warnings(weather, paris, "w").empty()) << "the parts take precedence";
  WeatherInterval moment;
  moment.dni_w_m2 = 1400.0;
  moment.dhi_w_m2 = 100.0;
  const SunPosition high{80.0 * degree, 0.0};
  ASSERT_EQ(moment_warnings(moment, high, {}, "w").size(), 1U);
  EXPECT_EQ(moment_warnings(moment, high, {}, "w")[0], "w: dni = 1400 W m-2 is more than the sun can send; at most 1361");
  EXPECT_TRUE(moment_warnings(moment, high, 3, "w").empty()) << "in January the sun is nearer";
  moment.dni_w_m2 = 0.0;
  moment.dhi_w_m2 = 700.0;
  EXPECT_TRUE(moment_warnings(moment, high, {}, "w").empty());
  EXPECT_EQ(moment_warnings(moment, {10.0 * degree, 0.0}, {}, "w").size(), 1U);
}

}  // namespace
}  // namespace sunfleck

#include "physics/light/sun.h"

#include "base/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "physics/light/sun_events.h"
#include "support/error_text.h"

namespace sunfleck {
namespace {

Place place_deg(double latitude, double longitude, double altitude_m = 0.0) {
  return {latitude * degree, longitude * degree, altitude_m};
}

double great_circle_deg(const SunPosition& sun, double elevation_deg, double azimuth_deg) {
  const glm::dvec3 a = direction_to_sun(sun);
  const glm::dvec3 b = direction_to_sun({elevation_deg * degree, azimuth_deg * degree});
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

const Place field = place_deg(40.02, 116.28);  // the paper's maize field in Beijing

// Worked example of Reda and Andreas (2004). The SPA claims 0.0003 degrees.
TEST(sun_position, matches_the_spa_worked_example) {
  const Place golden = place_deg(39.742476, -105.1786, 1830.14);
  const SunPosition sun = sun_position({2003, 10, 17, 19, 30, 30.0}, golden, 67.0);
  EXPECT_NEAR(sun.elevation_rad / degree, 39.872046, 0.0003);
  EXPECT_NEAR(sun.azimuth_rad / degree, 194.340241, 0.0003);
  EXPECT_NEAR(apparent_elevation_rad(sun.elevation_rad, {820.0, 11.0}) / degree, 90.0 - 50.11162, 0.0003);
  EXPECT_NEAR(apparent_elevation_rad(39.872046 * degree, {820.0, 11.0}) / degree, 39.888378, 1e-6);

  const SunPosition next = sun_position({2003, 10, 18, 19, 30, 30.0}, golden, 67.0);
  EXPECT_NEAR(next.elevation_rad / degree, 39.505196, 0.0003);
  EXPECT_NEAR(next.azimuth_rad / degree, 194.311132, 0.0003);
}

// SPA figures to three decimals: the tolerance is 0.0003 of the SPA plus half a unit of the last digit.
TEST(sun_position, matches_the_spa_over_the_papers_day) {
  const struct {
    int hour_cst;
    double elevation_deg, azimuth_deg;
  } rows[] = {{6, 6.556, 74.229},    {7, 17.807, 83.436},   {8, 29.269, 92.968},   {9, 40.615, 103.834},  {10, 51.347, 117.757},
              {11, 60.451, 137.891}, {12, 65.766, 167.896}, {13, 64.674, 202.607}, {14, 57.834, 229.326}, {15, 48.042, 247.036},
              {16, 37.031, 259.725}, {17, 25.595, 270.019}, {18, 14.151, 279.348}, {19, 3.006, 288.599}};
  for (const auto& row : rows) {
    const UtcTime time = plus_seconds({2002, 8, 8, 0, 0, 0.0}, (row.hour_cst - 8) * 3600.0);
    EXPECT_LT(great_circle_deg(sun_position(time, field), row.elevation_deg, row.azimuth_deg), 0.001) << row.hour_cst;
  }
}

TEST(sun_position, matches_the_papers_instant) {
  const SunPosition sun = sun_position({2002, 8, 8, 2, 10, 0.0}, field);
  EXPECT_NEAR(sun.elevation_rad / degree, 53.0176, 0.0004);
  EXPECT_NEAR(sun.azimuth_rad / degree, 120.5690, 0.0004);
  EXPECT_NEAR(apparent_elevation_rad(sun.elevation_rad, {1000.0, 28.0}) / degree, 90.0 - 36.9706, 0.0004);
  const glm::dvec3 to_sun = direction_to_sun(sun);
  EXPECT_NEAR(to_sun.x, 0.30594368, 1e-5);
  EXPECT_NEAR(to_sun.y, 0.79882034, 1e-5);
  EXPECT_NEAR(to_sun.z, -0.51796191, 1e-5);
}

TEST(sun_position, matches_the_spa_elsewhere) {
  EXPECT_LT(great_circle_deg(sun_position({2002, 8, 8, 4, 20, 0.0}, field), 66.1779, 179.6626), 0.0005);
  EXPECT_LT(great_circle_deg(sun_position({1995, 5, 15, 8, 30, 0.0}, place_deg(44.8378, -0.5792)), 39.7073, 103.6197), 0.0005);
  EXPECT_LT(great_circle_deg(sun_position({2021, 12, 21, 2, 0, 0.0}, place_deg(-33.8688, 151.2093)), 79.4586, 351.3299),
            0.0005);
}

// A second of UT1 turns the earth by 15"; a second of terrestrial time alone moves the sun by 0.04".
TEST(sun_position, hardly_depends_on_delta_t) {
  const UtcTime time{2002, 8, 8, 2, 10, 0.0};
  const SunPosition without = sun_position(time, field, 0.0), with = sun_position(time, field, 64.2);
  const double moved_deg = great_circle_deg(with, without.elevation_rad / degree, without.azimuth_rad / degree);
  EXPECT_GT(moved_deg, 0.0001);
  EXPECT_LT(moved_deg, 0.001);
}

TEST(sun_position, works_from_1900_to_2100) {
  EXPECT_NEAR(default_delta_t_s({1900, 1, 1}), -2.8, 0.2);  // Espenak and Meeus (2006), table of delta T
  EXPECT_NEAR(default_delta_t_s({1950, 1, 1}), 29.1, 0.2);
  EXPECT_NEAR(default_delta_t_s({1971, 12, 31}), default_delta_t_s({1972, 1, 1}), 0.3);
  EXPECT_DOUBLE_EQ(default_delta_t_s({2002, 8, 8}), 32.0 + 32.184);
  EXPECT_DOUBLE_EQ(default_delta_t_s({2100, 12, 31}), 37.0 + 32.184);
  // Seen from the pole at the June solstice, the sun's elevation is the mean obliquity of the date (Capitaine et al. 2003,
  // first two terms). It changes by 0.001 degrees within six hours; nutation adds 0.0026, parallax 0.0024.
  for (int year = 1900; year <= 2100; ++year) {
    double highest_deg = 0.0;
    for (int hour = 0; hour < 72; hour += 6) {
      const UtcTime time = plus_seconds({year, 6, 20}, hour * 3600.0);
      highest_deg = std::max(highest_deg, sun_position(time, place_deg(90.0, 0.0)).elevation_rad / degree);
    }
    EXPECT_NEAR(highest_deg, 23.439279 - 0.0130102 * (year - 2000.0) / 100.0, 0.006) << year;
  }
  EXPECT_NO_THROW(static_cast<void>(sun_position({2016, 12, 31, 23, 59, 60.5}, field)));
}

TEST(sun_position, refuses_times_that_do_not_exist) {
  const std::vector<UtcTime> wrong = {{2002, 2, 29},          {2002, 13, 1},
                                      {2002, 0, 1},           {2002, 4, 31},
                                      {2002, 4, 0},           {1899, 12, 31},
                                      {2101, 1, 1},           {-2000000000, 1, 1},
                                      {2002, 4, 3, 24},       {2002, 4, 3, -1},
                                      {2002, 4, 3, 1, 60},    {2002, 4, 3, 1, 2, 61.0},
                                      {2002, 4, 3, 1, 2, -1}, {2002, 4, 3, 1, 2, std::nan("")}};
  for (const UtcTime& time : wrong) {
    const std::string message = refusal_of([&] { static_cast<void>(sun_position(time, field)); });
    EXPECT_NE(message.find("); "), std::string::npos)
        << message << time.year << '-' << time.month << '-' << time.day << ' ' << time.hour << ':' << time.minute;
  }
}

TEST(apparent_elevation, bends_most_at_the_horizon_and_not_below) {
  const Air air{1010.0, 10.0};
  EXPECT_NEAR(apparent_elevation_rad(-0.5667 * degree, air) / degree, 0.0, 0.06);
  EXPECT_NEAR(apparent_elevation_rad(90.0 * degree, air) / degree, 90.0, 1e-4);
  EXPECT_EQ(apparent_elevation_rad(-0.84 * degree, air), -0.84 * degree);
  EXPECT_EQ(apparent_elevation_rad(20.0 * degree, {0.0, 10.0}), 20.0 * degree);
}

TEST(direction_to_sun, is_exact_on_the_axes) {
  const glm::dvec3 expected[] = {{-1, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}};  // north, east, south, west
  for (int quarter = 0; quarter < 5; ++quarter) {
    const double azimuth_rad = quarter * 90.0 * degree;
    EXPECT_EQ(direction_to_sun({0.0, azimuth_rad}), expected[quarter]);
    EXPECT_EQ(direction_to_sun({90.0 * degree, azimuth_rad}), glm::dvec3(0, 1, 0));
    const glm::dvec3 slanted = direction_to_sun({30.0 * degree, azimuth_rad});
    EXPECT_EQ(expected[quarter].x == 0.0, slanted.x == 0.0);
    EXPECT_EQ(expected[quarter].z == 0.0, slanted.z == 0.0);
  }
  EXPECT_EQ(direction_to_sun({-90.0 * degree, 1.0}), glm::dvec3(0, -1, 0));
}

TEST(direction_to_sun, keeps_small_but_real_components) {
  const glm::dvec3 direction = direction_to_sun({89.9999 * degree, 120.0 * degree});
  EXPECT_NE(direction.x, 0.0);
  EXPECT_NE(direction.z, 0.0);
  EXPECT_NEAR(glm::length(direction), 1.0, 1e-15);
}

TEST(plus_seconds, crosses_days_months_and_years) {
  const UtcTime later = plus_seconds({2003, 12, 31, 23, 59, 30.0}, 45.25);
  EXPECT_EQ(later.year, 2004);
  EXPECT_EQ(later.month, 1);
  EXPECT_EQ(later.day, 1);
  EXPECT_EQ(later.hour, 0);
  EXPECT_EQ(later.minute, 0);
  EXPECT_NEAR(later.second, 15.25, 1e-9);
  EXPECT_EQ(plus_seconds({2004, 3, 1}, -86400.0).day, 29);
  EXPECT_NEAR(seconds_between({2004, 2, 28, 12}, plus_seconds({2004, 2, 28, 12}, 200000.5)), 200000.5, 1e-4);
  for (int minute = 0; minute < 60; ++minute) {
    EXPECT_EQ(seconds_between({2004, 2, 28, 23, minute}, {2004, 3, 1, 0, 59 - minute}), 86400.0 + 7140.0 - 120.0 * minute);
  }
}

// Figures of the NREL SPA calculator, as clock times with the given offset. The calculator reports the events of a UTC date:
// the sunset it lists under 2 August 2015 happens at 02:13:58 UTC, which is the evening of 1 August in Golden.
TEST(sun_events, match_the_spa_calculator) {
  const Place golden = place_deg(39.742476, -105.1786), south = place_deg(-35.0, 0.0), ohio = place_deg(40.0, -80.0);
  const auto at = [](int hour, int minute, int second) { return hour * 3600.0 + minute * 60.0 + second; };
  const LocalDate august_1st{2015, 8, 1, -420}, august_2nd{2015, 8, 2, -420};
  const struct {
    LocalDate date;
    Place place;
    std::optional<double> rise_s, transit_s, set_s;
  } rows[] = {{{2015, 1, 2, -420}, golden, at(7, 21, 55), at(12, 4, 45), at(16, 47, 43)},
              {august_1st, golden, {}, {}, at(19, 13, 58)},
              {august_2nd, golden, at(5, 0, 27), at(12, 6, 58), {}},
              {{1996, 7, 5, 0}, south, at(7, 8, 15), at(12, 4, 36), at(17, 1, 4)},
              {{2004, 12, 4, 0}, south, at(4, 38, 57), at(11, 50, 22), at(19, 2, 3)},
              {{2000, 1, 1, -300}, ohio, at(7, 41, 51), at(12, 23, 23), at(17, 5, 4)}};
  for (const auto& row : rows) {
    const SunEvents events = sun_events(row.date, row.place);
    const UtcTime midnight = plus_seconds({row.date.year, row.date.month, row.date.day}, -60.0 * row.date.offset_minutes);
    const auto clock_s = [&](const UtcTime& time) { return seconds_between(midnight, time); };
    ASSERT_TRUE(events.sunrise && events.sunset);
    if (row.rise_s) {
      EXPECT_NEAR(clock_s(*events.sunrise), *row.rise_s, 5.0);
    }
    if (row.transit_s) {
      EXPECT_NEAR(clock_s(events.transit), *row.transit_s, 5.0);
    }
    if (row.set_s) {
      EXPECT_NEAR(clock_s(*events.sunset), *row.set_s, 5.0);
    }
  }
  // That sunset belongs to the 1st: a day later the sun is at -0.8333 degrees over a minute earlier.
  const SunPosition a_day_later = sun_position({2015, 8, 3, 2, 13, 58.0}, golden);
  EXPECT_LT(a_day_later.elevation_rad, rise_set_elevation_rad - 0.15 * degree);
}

TEST(sun_events, know_polar_day_and_night) {
  const Place svalbard = place_deg(78.22, 15.65);
  const SunEvents summer = sun_events({2020, 6, 21, 60}, svalbard);
  EXPECT_FALSE(summer.sunrise || summer.sunset);
  EXPECT_GT(sun_position(summer.transit, svalbard).elevation_rad, 0.0);
  const SunEvents winter = sun_events({2020, 12, 21, 60}, svalbard);
  EXPECT_FALSE(winter.sunrise || winter.sunset);
  EXPECT_LT(sun_position(winter.transit, svalbard).elevation_rad, 0.0);
}

TEST(sun_events, belong_together_whatever_the_clock) {
  const SunEvents local = sun_events({2002, 8, 8, 480}, field);
  ASSERT_TRUE(local.sunrise && local.sunset);
  EXPECT_EQ(local.sunrise->day, 7);  // 05:19 in Beijing is still the previous evening in Greenwich
  EXPECT_EQ(local.sunset->day, 8);
  EXPECT_NEAR(sun_position(*local.sunrise, field).elevation_rad, rise_set_elevation_rad, 1e-5);
  EXPECT_NEAR(sun_position(*local.sunset, field).elevation_rad, rise_set_elevation_rad, 1e-5);
  EXPECT_NEAR(sun_position(local.transit, field).azimuth_rad, std::numbers::pi, 1e-5);
  EXPECT_LT(std::abs(seconds_between({2002, 8, 8, 4}, sun_events({2002, 8, 8, 480}, field).transit)), 1800.0);
}

TEST(sun_events, refuse_dates_and_offsets_that_do_not_exist) {
  EXPECT_THROW(static_cast<void>(sun_events({2002, 2, 30, 0}, field)), Error);
  EXPECT_THROW(static_cast<void>(sun_events({2002, 2, 3, 1440}, field)), Error);
  EXPECT_THROW(static_cast<void>(sun_events({1800, 2, 3, 0}, field)), Error);
}

}  // namespace
}  // namespace sunfleck

#include "physics/light/weather.h"

#include "base/units.h"
#include "support/error_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace sunfleck {
namespace {

constexpr SunPosition paper_sun{53.0176 * degree, 120.569 * degree};
constexpr int paper_day = 220;  // 8 August

TEST(Weather, DayOfYear) {
  EXPECT_EQ(day_of_year({2002, 8, 8}), paper_day);
  EXPECT_EQ(day_of_year({2001, 1, 1}), 1);
  EXPECT_EQ(day_of_year({2001, 12, 31}), 365);
  EXPECT_EQ(day_of_year({2000, 12, 31}), 366);
  EXPECT_EQ(day_of_year({2000, 2, 29}), 60);
  EXPECT_EQ(day_of_year({1900, 3, 1}), 60);
}

// The relation worked out by hand, given with five digits.
TEST(Weather, SpittersKnownShares) {
  EXPECT_NEAR(extraterrestrial_normal_w_m2(1370.0, paper_day) * std::sin(paper_sun.elevation_rad), 1065.536, 5e-4);
  EXPECT_NEAR(spitters_diffuse_share(800.0, paper_sun, paper_day), 0.22454, 5e-6);
  EXPECT_NEAR(spitters_diffuse_share(400.0, paper_sun, paper_day), 0.84684, 5e-6);
  EXPECT_EQ(spitters_diffuse_share(200.0, paper_sun, paper_day), 1.0);  // t = 0.188
  const double t = 300.0 / 1065.536;
  EXPECT_NEAR(spitters_diffuse_share(300.0, paper_sun, paper_day), 1.0 - 6.4 * (t - 0.22) * (t - 0.22), 1e-6);
  const Broadband split = split_global(800.0, SplitRule::spitters, paper_sun, paper_day);
  EXPECT_NEAR(0.5 * split.direct_horizontal_w_m2(paper_sun), 310.19, 0.01);
  EXPECT_NEAR(0.5 * split.diffuse_w_m2, 89.82, 0.005);
}

// The polynomial of Erbs et al. at round clearness indices, summed by hand.
TEST(Weather, ErbsKnownShares) {
  const double outside_w_m2 = extraterrestrial_normal_w_m2(1367.0, paper_day) * std::sin(paper_sun.elevation_rad);
  const auto share = [&](double k) { return erbs_diffuse_share(k * outside_w_m2, paper_sun, paper_day); };
  EXPECT_DOUBLE_EQ(share(0.0), 1.0);
  EXPECT_NEAR(share(0.2), 1.0 - 0.018, 1e-12);
  EXPECT_NEAR(share(0.5), 0.9511 - 0.0802 + 1.097 - 2.07975 + 0.771, 1e-12);
  EXPECT_NEAR(share(0.9), 0.165, 1e-12);
}

// Reference values for sea level, Linke turbidity 3 and 1364 W m-2 outside the atmosphere, given with seven digits.
TEST(Weather, IneichenKnownClearSkies) {
  struct Case {
    double apparent_zenith_deg, air_mass, ghi, dni, dhi;
  };
  for (const Case& known :
       {Case{46.0467599, 1.32355476, 704.6968, 888.9015, 87.7360}, Case{10.56413562, 0.93527685, 1044.1231, 953.2493, 107.0311},
        Case{72.41687122, 3.01614096, 251.9943, 655.4493, 53.9901}}) {
    const double zenith_rad = known.apparent_zenith_deg * degree;
    const Broadband got = ineichen_perez({.linke_turbidity = 3.0, .altitude_m = 0.0}, zenith_rad, known.air_mass, 1364.0);
    EXPECT_NEAR(got.direct_normal_w_m2, known.dni, 1e-4);
    EXPECT_NEAR(got.diffuse_w_m2, known.dhi, 1e-4);
    EXPECT_NEAR(got.global_w_m2({std::numbers::pi / 2.0 - zenith_rad, 0.0}), known.ghi, 1e-4);
  }
}

// The air masses of the cases above were computed for a station whose pressure is 0.91975 of that at sea level.
TEST(Weather, AirMassOfKastenAndYoung) {
  EXPECT_NEAR(0.91975021 * relative_air_mass((90.0 - 46.0467599) * degree), 1.32355476, 2e-8);
  EXPECT_NEAR(0.91975021 * relative_air_mass((90.0 - 72.41687122) * degree), 3.01614096, 4e-8);
  EXPECT_NEAR(relative_air_mass((90.0 - 36.9824) * degree), 1.25085, 5e-6);
  EXPECT_NEAR(relative_air_mass(0.0), 37.92, 0.01);  // on the horizon, from their table
  EXPECT_NEAR(standard_pressure_hpa(0.0), 1013.25, 1e-9);
  EXPECT_NEAR(standard_pressure_hpa(1000.0), 898.75, 0.01);  // ISO 2533
  EXPECT_NEAR(standard_pressure_hpa(5000.0), 540.20, 0.02);
}

TEST(Weather, TheBeamIsWhatIsNotDiffuse) {
  const double sine = std::sin(paper_sun.elevation_rad);
  const Broadband plain = without_diffuse(600.0, 150.0, paper_sun, paper_day);
  EXPECT_NEAR(plain.direct_normal_w_m2, 450.0 / sine, 1e-10);
  EXPECT_NEAR(plain.diffuse_w_m2, 150.0, 1e-10);
  const Broadband all_diffuse = without_diffuse(100.0, 104.0, paper_sun, paper_day);
  EXPECT_EQ(all_diffuse.direct_normal_w_m2, 0.0);
  EXPECT_EQ(all_diffuse.diffuse_w_m2, 100.0);
  // With a low sun, noise must not make a beam that is stronger than outside the atmosphere.
  const SunPosition low{0.01, 2.0};
  const Broadband capped = without_diffuse(60.0, 20.0, low, paper_day);
  EXPECT_NEAR(capped.direct_normal_w_m2, extraterrestrial_normal_w_m2(1367.0, paper_day), 1e-9);
  EXPECT_NEAR(capped.global_w_m2(low), 60.0, 1e-10);
  EXPECT_EQ(without_diffuse(5.0, 1.0, {-0.01, 2.0}, paper_day).diffuse_w_m2, 5.0);
}

TEST(Weather, ClearSkyIsThatOfTheSeenSun) {
  const ClearAir air{.linke_turbidity = 3.0, .altitude_m = 300.0};
  for (const double elevation_deg : {0.001, 0.5, 3.0, 20.0, 53.0176, 89.999, 90.0}) {
    const SunPosition sun{elevation_deg * degree, 2.0};
    const Broadband got = clear_sky(air, sun, paper_day);
    const double apparent_rad =
        std::min(90.0 * degree, apparent_elevation_rad(sun.elevation_rad, {.pressure_hpa = standard_pressure_hpa(300.0)}));
    const Broadband seen = ineichen_perez(air, 90.0 * degree - apparent_rad,
                                          relative_air_mass(apparent_rad) * standard_pressure_hpa(300.0) / 1013.25,
                                          extraterrestrial_normal_w_m2(1367.0, paper_day));
    const double global_w_m2 = seen.direct_normal_w_m2 * std::sin(apparent_rad) + seen.diffuse_w_m2;
    EXPECT_NEAR(got.direct_normal_w_m2, seen.direct_normal_w_m2, 1e-9 * seen.direct_normal_w_m2) << elevation_deg;
    EXPECT_NEAR(got.global_w_m2(sun), global_w_m2, 1e-9 * global_w_m2) << elevation_deg;
    EXPECT_GT(got.diffuse_w_m2, 0.0);
  }
}

TEST(Weather, ClearSkyFallsWithTurbidityAndRisesWithAltitude) {
  double last_beam_w_m2 = 1e9;
  for (double turbidity = 1.0; turbidity <= 20.0; turbidity += 0.5) {
    const Broadband got = clear_sky({turbidity, 0.0}, paper_sun, paper_day);
    EXPECT_LT(got.direct_normal_w_m2, last_beam_w_m2);
    EXPECT_GE(got.diffuse_w_m2, 0.0);
    last_beam_w_m2 = got.direct_normal_w_m2;
  }
  EXPECT_GT(clear_sky({3.0, 2000.0}, paper_sun, paper_day).direct_normal_w_m2,
            clear_sky({3.0, 0.0}, paper_sun, paper_day).direct_normal_w_m2);
}

// Returns the global irradiance of Ineichen and Perez 2002 without a bound, and the largest beam that their rule for diffuse
// light allows beside it.
Broadband unbounded_clear_sky(const ClearAir& air, double cosine, double air_mass, double outside_w_m2) {
  const double fh1 = std::exp(-air.altitude_m / 8000.0), fh2 = std::exp(-air.altitude_m / 1250.0);
  const double cg1 = 5.09e-5 * air.altitude_m + 0.868, cg2 = 3.92e-5 * air.altitude_m + 0.0387;
  const double turbid = air.linke_turbidity - 1.0;
  const double global_w_m2 = cg1 * outside_w_m2 * cosine * std::exp(-cg2 * air_mass * (fh1 + fh2 * turbid));
  const double by_turbidity_w_m2 = (0.664 + 0.163 / fh1) * outside_w_m2 * std::exp(-0.09 * air_mass * turbid);
  const double most_share = 1.0 - (0.1 - 0.2 * std::exp(-air.linke_turbidity)) / (0.1 + 0.882 / fh1);
  const double beam_w_m2 = std::min(by_turbidity_w_m2, global_w_m2 * most_share / cosine);
  return {beam_w_m2, global_w_m2 - beam_w_m2 * cosine};
}

TEST(Weather, ClearSkyIsNoBrighterThanTheSun) {
  for (double altitude_m = -500.0; altitude_m <= 9000.0; altitude_m += 500.0) {
    for (const double turbidity : {1.0, 2.0, 3.0, 6.0, 20.0}) {
      for (double zenith_deg = 0.0; zenith_deg < 90.0; zenith_deg += 10.0) {
        const ClearAir air{turbidity, altitude_m};
        const double zenith_rad = zenith_deg * degree, cosine = std::cos(zenith_rad);
        const double air_mass = relative_air_mass(90.0 * degree - zenith_rad) * standard_pressure_hpa(altitude_m) / 1013.25;
        const Broadband got = ineichen_perez(air, zenith_rad, air_mass, 1367.0);
        const double global_w_m2 = got.direct_normal_w_m2 * cosine + got.diffuse_w_m2;
        const std::string where = fmt::format("{} m, turbidity {}, zenith {}", altitude_m, turbidity, zenith_deg);
        EXPECT_LE(got.direct_normal_w_m2, 1367.0) << where;
        EXPECT_LE(global_w_m2, (1.0 + 1e-12) * 1367.0 * cosine) << where;
        EXPECT_GE(got.diffuse_w_m2, 0.0) << where;
        if (altitude_m > 4000.0) continue;
        const Broadband fitted = unbounded_clear_sky(air, cosine, air_mass, 1367.0);
        EXPECT_NEAR(got.direct_normal_w_m2, fitted.direct_normal_w_m2, 1e-9) << where;
        EXPECT_NEAR(got.diffuse_w_m2, fitted.diffuse_w_m2, 1e-9) << where;
      }
    }
  }
  EXPECT_NEAR(clear_sky({2.0, 9000.0}, paper_sun, paper_day).global_w_m2(paper_sun),
              extraterrestrial_normal_w_m2(1367.0, paper_day) * std::sin(paper_sun.elevation_rad), 0.2);
}

// For any irradiance and any sun: no part is negative, both add up, and the beam is no stronger than outside the atmosphere.
TEST(Weather, SplitsAddUpAndAreNeverNegative) {
  for (const SplitRule rule : {SplitRule::spitters, SplitRule::erbs}) {
    for (const double elevation_deg : {-10.0, 0.0, 1e-9, 0.01, 0.5, 2.0, 10.0, 30.0, 60.0, 89.99, 90.0}) {
      const SunPosition sun{elevation_deg * degree, 1.0};
      for (const double global_w_m2 : {0.0, 1e-12, 0.1, 5.0, 50.0, 200.0, 400.0, 600.0, 800.0, 1000.0, 1300.0, 3000.0}) {
        const Broadband got = split_global(global_w_m2, rule, sun, paper_day);
        EXPECT_GE(got.direct_normal_w_m2, 0.0);
        EXPECT_GE(got.diffuse_w_m2, 0.0);
        EXPECT_LE(got.direct_normal_w_m2, 1.034 * 1370.0);
        EXPECT_NEAR(got.global_w_m2(sun), global_w_m2, 1e-12 * global_w_m2);
        if (elevation_deg <= 0.0) {
          EXPECT_EQ(got.diffuse_w_m2, global_w_m2);
        }
      }
    }
  }
}

TEST(Weather, SplitsAreContinuousWhereTheirPiecesMeet) {
  const double outside_w_m2 = extraterrestrial_normal_w_m2(1370.0, paper_day) * std::sin(paper_sun.elevation_rad);
  const double sine = std::sin(paper_sun.elevation_rad);
  const double k = (1.47 - (0.847 - 1.61 * sine + 1.04 * sine * sine)) / 1.66;
  for (const double t : {0.22, k}) {
    EXPECT_NEAR(spitters_diffuse_share((t - 1e-9) * outside_w_m2, paper_sun, paper_day),
                spitters_diffuse_share((t + 1e-9) * outside_w_m2, paper_sun, paper_day), 1e-7);
  }
}

TEST(Weather, TheSunBelowTheHorizonSendsNoBeam) {
  const SunPosition night{-0.1, 0.0};
  EXPECT_EQ(clear_sky({}, night, paper_day).global_w_m2(night), 0.0);
  EXPECT_EQ(clear_sky({}, {0.0, 0.0}, paper_day).diffuse_w_m2, 0.0);
  EXPECT_EQ((Broadband{500.0, 20.0}.direct_horizontal_w_m2(night)), 0.0);
  EXPECT_EQ((Broadband{500.0, 20.0}.global_w_m2(night)), 20.0);
}

Weather hourly(int count) {
  Weather weather;
  weather.source = Weather::Source::intervals;
  weather.name = "station.csv";
  for (int i = 0; i < count; ++i) {
    weather.intervals.push_back({.start = plus_seconds({2002, 8, 7, 22}, 3600.0 * i), .ghi_w_m2 = 100.0 * i});
  }
  return weather;
}

TEST(Weather, IntervalsHoldTheirStartButNotTheirEnd) {
  const Weather weather = hourly(5);
  EXPECT_EQ(interval_at(weather, {2002, 8, 7, 22, 0, 0.0}).ghi_w_m2, 0.0);
  EXPECT_EQ(interval_at(weather, {2002, 8, 7, 22, 59, 59.999}).ghi_w_m2, 0.0);
  EXPECT_EQ(interval_at(weather, {2002, 8, 7, 23, 0, 0.0}).ghi_w_m2, 100.0);
  EXPECT_EQ(interval_at(weather, {2002, 8, 8, 2, 59, 0.0}).ghi_w_m2, 400.0);
  const Broadband got = weather_at(weather, UtcTime{2002, 8, 8, 2, 10}, paper_sun);
  EXPECT_NEAR(got.diffuse_w_m2 / 400.0, 0.84684, 5e-6);
  EXPECT_NEAR(got.global_w_m2(paper_sun), 400.0, 1e-10);
}

TEST(Weather, AStepLongerThanIntervalsHasTheirMean) {
  Weather weather = hourly(5);
  for (WeatherInterval& interval : weather.intervals) {
    interval.dni_w_m2 = 2.0 * interval.ghi_w_m2;
    interval.dhi_w_m2 = 0.3 * interval.ghi_w_m2;
  }
  const auto expect_mean = [&](const UtcTime& middle, double length_s, double hours) {
    const Broadband got = weather_of_step(weather, middle, length_s, paper_sun);
    EXPECT_NEAR(got.direct_normal_w_m2, 200.0 * hours, 1e-10) << length_s;
    EXPECT_NEAR(got.diffuse_w_m2, 30.0 * hours, 1e-10) << length_s;
  };
  expect_mean({2002, 8, 8, 0, 30}, 3.0 * 3600.0, 2.0);
  expect_mean({2002, 8, 8, 1, 0}, 1.5 * 3600.0, (0.75 * 2.0 + 0.75 * 3.0) / 1.5);
  expect_mean({2002, 8, 7, 22, 30}, 7200.0, (1.0 * 0.0 + 0.5 * 1.0) / 1.5);  // begins before the file
  weather.intervals[1].dhi_w_m2 = weather.intervals[1].ghi_w_m2 = -1.0;
  expect_mean({2002, 8, 8, 0, 30}, 3.0 * 3600.0, 2.5);  // what is marked as missing is left out
  weather.intervals.erase(weather.intervals.begin() + 1);
  expect_mean({2002, 8, 8, 0, 30}, 3.0 * 3600.0, 2.5);
  EXPECT_NE(refusal_of([&] {
              static_cast<void>(weather_of_step(weather, {2002, 8, 7, 23, 30}, 7200.0, paper_sun));
            }).find("gap"),
            std::string::npos);
}

// Where clocks differ from UTC by half an hour, as in India, hours of the clock lie across those of a file in UTC.
TEST(Weather, TheEndsOfAGapAreNamed) {
  Weather weather = hourly(5);
  weather.intervals.erase(weather.intervals.begin() + 2);
  EXPECT_NE(refusal_of([&] {
              static_cast<void>(weather_at(weather, UtcTime{2002, 8, 8, 0, 20}, paper_sun));
            }).find("nothing from 2002-08-08T00:00:00+00:00 to 2002-08-08T01:00:00+00:00"),
            std::string::npos);
}

TEST(Weather, AStepAcrossIntervalsHasTheMeanOfBoth) {
  Weather weather = hourly(5);
  for (WeatherInterval& interval : weather.intervals) interval.dni_w_m2 = interval.dhi_w_m2 = interval.ghi_w_m2;
  const auto diffuse = [&](int minute, double length_s) {
    return weather_of_step(weather, {2002, 8, 8, 1, minute}, length_s, paper_sun).diffuse_w_m2;
  };
  EXPECT_NEAR(diffuse(0, 3600.0), 250.0, 1e-10);
  EXPECT_NEAR(diffuse(15, 3600.0), 275.0, 1e-10);
  EXPECT_NEAR(diffuse(0, 600.0), 250.0, 1e-10);
  EXPECT_EQ(diffuse(30, 3600.0), 300.0);
  EXPECT_EQ(diffuse(5, 600.0), 300.0);
}

TEST(Weather, AStepWithinAnIntervalHasItsLight) {
  const Weather weather = hourly(5);
  const UtcTime middle{2002, 8, 8, 2, 35};
  const Broadband expected = weather_at(weather, middle, paper_sun);
  for (const double length_s : {600.0, 3600.0}) {
    const Broadband got = weather_of_step(weather, middle, length_s, paper_sun);  // half of the longer one lies beyond
    EXPECT_EQ(got.direct_normal_w_m2, expected.direct_normal_w_m2);
    EXPECT_EQ(got.diffuse_w_m2, expected.diffuse_w_m2);
  }
  const Weather clear{.source = Weather::Source::clear_sky};
  EXPECT_EQ(weather_of_step(clear, middle, 7200.0, paper_sun).diffuse_w_m2, weather_at(clear, middle, paper_sun).diffuse_w_m2);
}

std::string refusal(const Weather& weather, const UtcTime& time) {
  return refusal_of([&] { static_cast<void>(weather_at(weather, time, paper_sun)); });
}

TEST(Weather, TimesOutsideAreRefusedByName) {
  Weather weather = hourly(5);
  EXPECT_EQ(refusal(weather, {2002, 8, 7, 21, 59, 59.0}),
            "weather at 2002-08-07T21:59:59+00:00 (station.csv covers 2002-08-07T22:00:00+00:00 to 2002-08-08T03:00:00+00:00); "
            "choose a time that it covers, or add what is missing");
  EXPECT_NE(refusal(weather, {2002, 8, 8, 3, 0, 0.0}).find("covers"), std::string::npos);
  weather.intervals.erase(weather.intervals.begin() + 2);
  EXPECT_NE(refusal(weather, {2002, 8, 8, 0, 30, 0.0}).find("a gap there"), std::string::npos);
  weather.intervals[1].ghi_w_m2 = -1.0;
  weather.intervals[1].line = 7;
  EXPECT_EQ(
      refusal(weather, {2002, 8, 7, 23, 30, 0.0}),
      "station.csv:7: weather at 2002-08-07T23:30:00+00:00 (irradiance is marked as missing there); choose another time, or "
      "fill the value in");
}

TEST(Weather, PartsGoBeforeTheWhole) {
  Weather weather;
  weather.moment = {.ghi_w_m2 = 1.0, .dni_w_m2 = 700.0, .dhi_w_m2 = 120.0};
  const Broadband got = weather_at(weather, {}, paper_sun);
  EXPECT_EQ(got.direct_normal_w_m2, 700.0);
  EXPECT_EQ(got.diffuse_w_m2, 120.0);
}

// Covers half a day of local time and the turn of the year: hour i of the year carries the number i.
TEST(Weather, ATypicalYearHoldsInEveryYear) {
  Weather weather;
  weather.source = Weather::Source::intervals;
  weather.name = "typical.epw";
  weather.every_year = true;
  weather.zone_minutes = 480;
  for (int i = 0; i < 8760; ++i) {
    weather.intervals.push_back({.start = plus_seconds({2001, 1, 1}, 3600.0 * i - 28800.0), .ghi_w_m2 = 0.1 * i});
  }
  const auto hour = [&](const UtcTime& time) { return std::lround(10.0 * interval_at(weather, time).ghi_w_m2); };
  EXPECT_EQ(hour({1999, 12, 31, 16}), 0);
  EXPECT_EQ(hour({2035, 1, 1, 0}), 8);
  EXPECT_EQ(hour({2002, 8, 8, 2, 10}), (paper_day - 1) * 24 + 10);
  EXPECT_EQ(hour({2024, 8, 8, 2, 10}), (paper_day - 1) * 24 + 10);
  EXPECT_EQ(hour({2024, 12, 31, 15, 59, 59.0}), 8759);
  EXPECT_EQ(hour({2024, 2, 29, 3}), hour({2024, 2, 28, 3})) << "28 February stands for the day that the year lacks";
  EXPECT_EQ(hour({2024, 2, 29, 16}), 59 * 24);  // already 1 March local time
}

}  // namespace
}  // namespace sunfleck

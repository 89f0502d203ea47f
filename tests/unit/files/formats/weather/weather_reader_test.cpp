#include "files/formats/weather/weather_reader.h"

#include "files/formats/weather/station_reader.h"
#include "support/broken_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace sunfleck {
namespace {

const std::string good_csv =
    "# made up\n"
    "time,ghi\n"
    "2002-08-08T10:00:00+08:00,700\n"
    "2002-08-08T10:10:00+08:00,710.5\n"
    "\n"
    "2002-08-08T10:20:00+08:00,0\n";

constexpr int days_in[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};

// Returns a file whose GHI is 0 at night, and from 7 to 18 the hour's number times 10 plus month + day.
std::string epw(bool leap = false) {
  std::string text =
      "LOCATION,Beijing,Beijing,CHN,CSWD,545110,39.80,116.47,8.0,31.3\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\n"
      "GROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made up\nCOMMENTS 2,\n"
      "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";
  for (int month = 1; month <= 12; ++month) {
    const int days = days_in[month - 1] + (leap && month == 2 ? 1 : 0);
    for (int day = 1; day <= days; ++day) {
      for (int hour = 1; hour <= 24; ++hour) {
        const bool up = hour >= 7 && hour <= 18;
        text += fmt::format("{},{},{},{},60,?9?9?9,20.0,15.0,70,101000,0,1400,300,{},{},{},9999,9999,9999,9999\n", 1990 + month,
                            month, day, hour, up ? 10 * hour + month + day : 0, up ? 20 * hour : 0, up ? 5 * hour : 0);
      }
    }
  }
  return text;
}

TEST(StationReader, ReadsIntervals) {
  const TempFolder folder;
  const WeatherFile file = read_weather(folder.write("a.csv", good_csv));
  EXPECT_FALSE(file.place);
  EXPECT_EQ(file.weather.source, Weather::Source::intervals);
  EXPECT_EQ(file.weather.name, "a.csv");
  ASSERT_EQ(file.weather.intervals.size(), 3U);
  const WeatherInterval& second = file.weather.intervals[1];
  EXPECT_EQ(seconds_between({2002, 8, 8, 2, 10}, second.start), 0.0);
  EXPECT_NEAR(second.length_s, 600.0, 1e-6);
  EXPECT_EQ(second.ghi_w_m2, 710.5);
  EXPECT_LT(second.dni_w_m2, 0.0);
  EXPECT_EQ(second.line, 4U);
  EXPECT_NEAR(file.weather.intervals[2].length_s, 600.0, 1e-6);
  EXPECT_EQ(file.weather.intervals[2].line, 6U);
}

TEST(StationReader, ReadsPartsInAnyOrderAmongOtherColumns) {
  const TempFolder folder;
  const WeatherFile file = read_weather(
      folder.write("a.CSV",
                   "\xef\xbb\xbf"
                   "air, DHI ,time,dni\r\n21.5, 80,2002-08-08 10:00+0800 ,600\r\n,81.25,2002-08-08T02:10Z,6.1e2\r\n"));
  ASSERT_EQ(file.weather.intervals.size(), 2U);
  EXPECT_EQ(file.weather.intervals[0].dni_w_m2, 600.0);
  EXPECT_EQ(file.weather.intervals[1].dni_w_m2, 610.0);
  EXPECT_EQ(file.weather.intervals[1].dhi_w_m2, 81.25);
  EXPECT_NEAR(file.weather.intervals[0].length_s, 600.0, 1e-6);
}

TEST(StationReader, DoesNotReadGhiBesideItsParts) {
  const TempFolder folder;
  const WeatherFile file =
      read_weather(folder.write("a.csv",
                                "time,dni,dhi,ghi\n2002-08-08T10:00Z,500,100,\n2002-08-08T11:00Z,510,90,-9999\n"
                                "2002-08-08T12:00Z,520,80,9999\n2002-08-08T13:00Z,530,70,none\n"));
  ASSERT_EQ(file.weather.intervals.size(), 4U);
  EXPECT_EQ(file.weather.intervals[3].dni_w_m2, 530.0);
  for (const WeatherInterval& interval : file.weather.intervals) EXPECT_LT(interval.ghi_w_m2, 0.0);
}

// The cells are as R's write.csv writes them.
TEST(StationReader, ReadsQuotedCells) {
  const TempFolder folder;
  const WeatherFile file = read_weather(
      folder.write("a.csv", "\"time\",\"ghi\"\n\"2002-08-08T10:00:00+08:00\",700\n\"2002-08-08T10:10:00+08:00\", \"710.5\"\n"));
  ASSERT_EQ(file.weather.intervals.size(), 2U);
  EXPECT_EQ(file.weather.intervals[1].ghi_w_m2, 710.5);
}

TEST(StationReader, ReadsDiffuseBesideGlobalLight) {
  const TempFolder folder;
  const WeatherFile file =
      read_weather(folder.write("a.csv", "time,ghi,dhi\n2002-08-08T10:00Z,500,100\n2002-08-08T11:00Z,510,90\n"));
  ASSERT_EQ(file.weather.intervals.size(), 2U);
  EXPECT_EQ(file.weather.intervals[1].ghi_w_m2, 510.0);
  EXPECT_EQ(file.weather.intervals[1].dhi_w_m2, 90.0);
  EXPECT_FALSE(file.weather.intervals[1].has_parts());
}

// As spreadsheets write them where a comma is the decimal mark.
TEST(StationReader, ReadsSemicolonsAndTabsWithDecimalCommas) {
  const TempFolder folder;
  for (const std::string separator : {";", "\t"}) {
    const auto row = [&](std::string_view time, std::string_view value) {
      return fmt::format("{}{}{}\n", time, separator, value);
    };
    const WeatherFile file = read_weather(folder.write(
        "a.csv", row("time", "ghi") + row("2002-08-08 10:00:00,5+08:00", "1.5") + row("2002-08-08 10:10+08:00", "710,25")));
    ASSERT_EQ(file.weather.intervals.size(), 2U);
    EXPECT_EQ(file.weather.intervals[0].ghi_w_m2, 1.5);
    EXPECT_EQ(file.weather.intervals[1].ghi_w_m2, 710.25);
  }
}

TEST(StationReader, GivesTimesWithoutOffsetTheOneGiven) {
  const TempFolder folder;
  const auto file = folder.write("a.csv", "time,ghi\n2002-08-08 10:00,1\n2002-08-08 10:10:00,2\n");
  const WeatherFile read = read_weather(file, nullptr, 330);
  EXPECT_EQ(read.weather.zone_minutes, 330);
  EXPECT_EQ(seconds_between({2002, 8, 8, 4, 30}, read.weather.intervals[0].start), 0.0);
  expect_refusal([&] { static_cast<void>(read_weather(folder.write("b.csv", good_csv), nullptr, 330)); },
                 "although one is given for all times");
  expect_refusal([&] { static_cast<void>(read_weather(folder.write("c.epw", epw()), nullptr, 330)); },
                 "EPW file states its own");
}

TEST(StationReader, KnowsOffsets) {
  EXPECT_EQ(parse_utc_offset("Z"), 0);
  EXPECT_EQ(parse_utc_offset("+08"), 480);
  EXPECT_EQ(parse_utc_offset("-0330"), -210);
  EXPECT_EQ(parse_utc_offset("+05:30"), 330);
  for (const char* text : {"", "8", "+8", "+24:00", "+08:60", "+08:00 ", "UTC", "+08:0"})
    EXPECT_FALSE(parse_utc_offset(text)) << text;
}

TEST(StationReader, KnowsTheFormsOfATime) {
  const TempFolder folder;
  for (const char* time : {"2002-08-08T10:10:00+08:00", "2002-08-08T10:10+08:00", "2002-08-08 10:10:00 +0800",
                           "2002-08-08t10:10:00.000+08", "2002-08-08T02:10:00Z", "2002-08-07T19:40:00-06:30"}) {
    const WeatherFile file = read_weather(folder.write("a.csv", fmt::format("time,ghi\n{},1\n2002-08-09T00:00Z,2\n", time)));
    EXPECT_EQ(seconds_between({2002, 8, 8, 2, 10}, file.weather.intervals[0].start), 0.0) << time;
  }
  const WeatherFile file =
      read_weather(folder.write("a.csv", "time,ghi\n2024-02-29T23:59:59.25-00:01,1\n2024-03-02T00:00Z,2\n"));
  EXPECT_NEAR(seconds_between({2024, 3, 1, 0, 0, 59.25}, file.weather.intervals[0].start), 0.0, 1e-6);
}

// Lengths may vary, but a step longer than the most common one is a gap.
TEST(StationReader, LengthsAreStepsAndLongerOnesAreGaps) {
  const TempFolder folder;
  std::string text = "time,ghi\n";
  for (const char* time : {"10:00", "10:10", "10:20", "10:25", "10:30", "10:40", "12:00", "12:10", "12:15"}) {
    text += fmt::format("2002-08-08T{}:00Z,1\n", time);
  }
  const WeatherFile file = read_weather(folder.write("a.csv", text));
  std::vector<long> minutes;
  for (const WeatherInterval& interval : file.weather.intervals) minutes.push_back(std::lround(interval.length_s / 60.0));
  EXPECT_EQ(minutes, (std::vector<long>{10, 10, 5, 5, 10, 10, 10, 5, 5}));
  EXPECT_THROW(static_cast<void>(interval_at(file.weather, {2002, 8, 8, 11, 0})), Error);
  EXPECT_NO_THROW(static_cast<void>(interval_at(file.weather, {2002, 8, 8, 12, 19})));
}

// 10 minutes are no whole number of days in doubles.
TEST(StationReader, TheLastIntervalDoesNotHoldItsEnd) {
  const TempFolder folder;
  for (int minute = 0; minute < 30; ++minute) {
    const auto row = [&](int interval) { return fmt::format("2023-07-10T12:{:02}:00+02:00,500\n", minute + 10 * interval); };
    const Weather weather = read_weather(folder.write("a.csv", "time,ghi\n" + row(0) + row(1) + row(2))).weather;
    EXPECT_THROW(static_cast<void>(interval_at(weather, {2023, 7, 10, 10, minute + 30})), Error) << minute;
    EXPECT_EQ(interval_at(weather, {2023, 7, 10, 10, minute + 29, 59.999}).line, 4U) << minute;
  }
}

TEST(EpwReader, HoursEndAtTheirNumberInLocalTime) {
  const TempFolder folder;
  const WeatherFile file = read_weather(folder.write("a.epw", epw()));
  ASSERT_TRUE(file.place);
  EXPECT_NEAR(file.place->latitude_rad, 39.80 * 3.14159265358979323846 / 180.0, 1e-12);
  EXPECT_NEAR(file.place->altitude_m, 31.3, 1e-12);
  EXPECT_TRUE(file.weather.every_year);
  EXPECT_EQ(file.weather.zone_minutes, 480);
  ASSERT_EQ(file.weather.intervals.size(), 8760U);
  ASSERT_TRUE(file.years);
  EXPECT_EQ((*file.years)[7], 1998);
  // 10:10 local time lies in hour 11.
  const WeatherInterval& hour = interval_at(file.weather, {2002, 8, 8, 2, 10});
  EXPECT_EQ(hour.ghi_w_m2, 110.0 + 8.0 + 8.0);
  EXPECT_EQ(hour.dni_w_m2, 220.0);
  EXPECT_EQ(hour.dhi_w_m2, 55.0);
  EXPECT_EQ(hour.length_s, 3600.0);
  EXPECT_EQ(hour.line, 8U + (219U * 24U) + 11U);
  EXPECT_EQ(interval_at(file.weather, {2002, 8, 8, 1, 59, 59.0}).ghi_w_m2, 100.0 + 16.0);
  EXPECT_EQ(interval_at(file.weather, {2002, 8, 7, 16, 0}).ghi_w_m2, 0.0);  // hour 1 of 8 August
}

TEST(EpwReader, KeepsCommasInTheNameOfAPlace) {
  const TempFolder folder;
  const WeatherFile file = read_weather(folder.write("a.epw", swapped(epw(), "LOCATION,Beijing,", "LOCATION,\"Bei, jing\",")));
  ASSERT_TRUE(file.place);
  EXPECT_NEAR(file.place->latitude_rad, 39.80 * 3.14159265358979323846 / 180.0, 1e-12);
  EXPECT_NEAR(file.place->altitude_m, 31.3, 1e-12);
  EXPECT_EQ(file.weather.zone_minutes, 480);
}

TEST(WeatherReader, IgnoresTheEndMarkOfDos) {
  const TempFolder folder;
  EXPECT_EQ(read_weather(folder.write("a.epw", epw() + "\x1a")).weather.intervals.size(), 8760U);
  EXPECT_EQ(read_weather(folder.write("a.csv", good_csv + "\x1a\x1a")).weather.intervals.size(), 3U);
  EXPECT_THROW(static_cast<void>(read_weather(folder.write("b.csv", "\x1a"))), Error);
}

TEST(EpwReader, KnowsLeapYearsAndHalfHourZones) {
  const TempFolder folder;
  const WeatherFile leap = read_weather(folder.write("a.epw", epw(true)));
  EXPECT_EQ(leap.weather.intervals.size(), 8784U);
  EXPECT_EQ(interval_at(leap.weather, {2024, 2, 29, 2, 10}).ghi_w_m2, 110.0 + 2.0 + 29.0);
  EXPECT_EQ(interval_at(leap.weather, {2023, 3, 1, 2, 10}).ghi_w_m2, 110.0 + 3.0 + 1.0);
  const WeatherFile half = read_weather(folder.write("b.epw", swapped(epw(), ",8.0,", ",-3.5,")));
  EXPECT_EQ(half.weather.zone_minutes, -210);
  EXPECT_EQ(interval_at(half.weather, {2002, 8, 8, 13, 30}).ghi_w_m2, 110.0 + 16.0);
  EXPECT_EQ(interval_at(half.weather, {2002, 8, 8, 13, 29}).ghi_w_m2, 100.0 + 16.0);
}

TEST(EpwReader, MissingValuesAreRefusedWhenUsed) {
  const TempFolder folder;
  const std::string row = "1998,8,8,11,60,?9?9?9,20.0,15.0,70,101000,0,1400,300,126,220,55,";
  const auto with = [&](std::string_view values) {
    const std::string cut = row.substr(0, row.size() - std::string_view("126,220,55,").size());
    return read_weather(folder.write("a.epw", swapped(epw(), row, cut + std::string(values))));
  };
  const UtcTime time{2002, 8, 8, 2, 10};
  const SunPosition sun = sun_position(time, {0.7, 2.03, 0.0});
  EXPECT_EQ(weather_at(with("9999,220,55,").weather, time, sun).diffuse_w_m2, 55.0);
  EXPECT_NEAR(weather_at(with("126,9999,55,").weather, time, sun).global_w_m2(sun), 126.0, 1e-10);
  const WeatherFile none = with("9999,9999,99999,");
  const auto message = message_of([&] { static_cast<void>(weather_at(none.weather, time, sun)); });
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->starts_with("a.epw:5275: weather at 2002-08-08T10:10:00+08:00 (")) << *message;
  expect_three_parts(*message);
}

void expect_refused(const std::vector<Broken>& files) {
  expect_refused(files, [](const std::filesystem::path& file) { static_cast<void>(read_weather(file)); });
}

TEST(WeatherAttack, BrokenStations) {
  const auto bad = [](std::string_view from, std::string_view to) { return swapped(good_csv, from, to); };
  expect_refused({
      {"empty", "a.csv", "", ": ", "empty"},
      {"only comments", "a.csv", "# nothing\n\n", ": ", "no line of column names"},
      {"only a header", "a.csv", "time,ghi\n", ": ", "no row found"},
      {"one row", "a.csv", "time,ghi\n2002-08-08T10:00Z,1\n", ": ", "one row found"},
      {"no time column", "a.csv", bad("time,ghi", "date,ghi"), ":2: ", "no column is named time"},
      {"semicolons", "a.csv", bad("time,ghi", "time;ghi"), ":3: 1 cells", "separated by semicolons"},
      {"no irradiance", "a.csv", bad("time,ghi", "time,GHI_Wm2"), ":2: ", "no columns are named ghi"},
      {"dni alone", "a.csv", bad("time,ghi", "time,dni"), ":2: ", "column dhi is missing"},
      {"dhi alone", "a.csv", bad("time,ghi", "time,dhi"), ":2: ", "columns ghi and dni are missing"},
      {"dni beside ghi", "a.csv", bad("time,ghi", "time,ghi,dni"), ":2: ", "column dhi is missing"},
      {"column twice", "a.csv", bad("time,ghi", "time,ghi,ghi"), ":2: ", "appears twice"},
      {"cell missing", "a.csv", bad(",710.5", ""), ":4: ", "there are 2 columns"},
      {"cell too many", "a.csv", bad(",710.5", ",710,5"), ":4: ", "3 cells"},
      {"value empty", "a.csv", bad("710.5", ""), ":4: ghi ''", "must be a number"},
      {"value NaN", "a.csv", bad("710.5", "NaN"), ":4: ghi 'NaN'", "missing values are not interpolated"},
      {"value infinite", "a.csv", bad("710.5", "inf"), ":4: ghi 'inf'", "must be a number"},
      {"value a word", "a.csv", bad("710.5", "bright"), ":4: ghi 'bright'", "must be a number"},
      {"value negative", "a.csv", bad("710.5", "-3"), ":4: ghi = -3", "the night offset"},
      {"value missing", "a.csv", bad("710.5", "-9999"), ":4: ghi = -9999", "marks a missing value"},
      {"value huge", "a.csv", bad("710.5", "1e9"), ":4: ghi = 1000000000", "0..3000"},
      {"no offset", "a.csv", bad("10:10:00+08:00", "10:10:00"), ":4: time", "has no offset"},
      {"no time of day", "a.csv", bad("T10:10:00+08:00", ""), ":4: time", "ISO 8601"},
      {"slashes", "a.csv", bad("2002-08-08T10:10", "2002/08/08T10:10"), ":4: time", "ISO 8601"},
      {"offset unreadable", "a.csv", bad("10:10:00+08:00", "10:10:00+8"), ":4: time", "offset from UTC cannot be read"},
      {"offset too far", "a.csv", bad("10:10:00+08:00", "10:10:00+24:00"), ":4: time", "offset from UTC cannot be read"},
      {"text behind", "a.csv", bad("10:10:00+08:00", "10:10:00+08:00 h"), ":4: time", "offset from UTC cannot be read"},
      {"no such day", "a.csv", bad("2002-08-08T10:10", "2002-02-29T10:10"), ":4: time", "no such date"},
      {"no such hour", "a.csv", bad("T10:10", "T24:10"), ":4: time", "no such date"},
      {"year beyond", "a.csv", bad("2002-08-08T10:10", "2100-08-08T10:10"), ":4: time", "between 1900 and 2100"},
      {"descending", "a.csv", bad("T10:10", "T09:50"), ":4: time", "not later than that of line 3"},
      {"twice", "a.csv", bad("T10:10", "T10:00"), ":4: time", "not later"},
      {"twice by zones", "a.csv", bad("T10:10:00+08:00", "T02:00:00Z"), ":4: time", "not later"},
      {"zero byte", "a.csv", good_csv + std::string(1, '\0'), ": ", "zero byte"},
      {"control characters", "a.csv", "\x01\x02,\x1b[31m\n", ":1: ", "'\?\?'"},
      {"a picture", "a.csv", "\x89PNG\r\n\x1a\n\x01\x02", ":1: ", "no column is named time"},
      {"unknown format", "a.txt", good_csv, ": ", "unknown format"},
  });
}

TEST(WeatherAttack, BrokenEpws) {
  const std::string good = epw();
  const auto bad = [&](std::string_view from, std::string_view to) { return swapped(good, from, to); };
  expect_refused({
      {"no location", "a.epw", bad("LOCATION", "PLACE"), ":1: ", "begins with LOCATION"},
      {"a station's file", "a.epw", good_csv, ":1: ", "begins with LOCATION"},
      {"latitude", "a.epw", bad("39.80", "139.80"), ":1: latitude = 139.8", "-90..90"},
      {"longitude a word", "a.epw", bad("116.47", "E"), ":1: longitude 'E'", "field 8"},
      {"time zone", "a.epw", bad(",8.0,", ",800,"), ":1: time zone = 800", "-12..14"},
      {"location cut", "a.epw", bad(",8.0,31.3", ""), ":1: time zone ''", "field 9"},
      {"header alone", "a.epw", good.substr(0, good.find("COMMENTS 2")), ": ", "ends after 6 lines"},
      {"records per hour", "a.epw", bad("DATA PERIODS,1,1", "DATA PERIODS,1,4"), ":8: 4 records per hour", "only one"},
      {"row missing", "a.epw", bad("1991,1,1,2,60,?9?9?9,20.0,15.0,70,101000,0,1400,300,0,0,0,9999,9999,9999,9999\n", ""),
       ":10: month 1, day 1, hour 3", "hour 2 of 1/1 is expected"},
      {"row twice", "a.epw", bad("1991,1,1,2,", "1991,1,1,1,"), ":10: ", "hour 2 of 1/1 is expected"},
      {"hour 0", "a.epw", bad("1991,1,1,1,", "1991,1,1,0,"), ":9: hour = 0", "1..24"},
      {"month 13", "a.epw", bad("1991,1,1,1,", "1991,13,1,1,"), ":9: month = 13", "1..12"},
      {"radiation a word", "a.epw", bad("300,0,0,0,", "300,x,0,0,"), ":9: global horizontal radiation 'x'", "field 14"},
      {"radiation negative", "a.epw", bad("300,0,0,0,", "300,0,-1,0,"), ":9: direct normal radiation = -1", "0..3000"},
      {"radiation too large", "a.epw", bad("300,0,0,0,", "300,0,0,5000,"), ":9: diffuse horizontal radiation = 5000", "9999"},
      {"row cut", "a.epw", good.substr(0, good.find("1991,1,2,1,") + 30), ":33: global horizontal radiation ''", "field 14"},
      {"half a year", "a.epw", good.substr(0, good.find("1997,7,1,1,")), ": 4344 rows found", "8760"},
      {"a day too many", "a.epw", good + "1992,1,1,1,60,?,0,0,0,0,0,0,0,0,0,0,\n", ":8769: ", "the year is over"},
  });
}

TEST(WeatherAttack, WhatIsNoFile) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "b.csv");
  for (const char* name : {"absent.csv", "absent.epw", "b.csv"}) {
    expect_refusal([&] { static_cast<void>(read_weather(folder / name)); });
  }
  const std::filesystem::path large = folder.write("large.csv", "time,ghi\n");
  std::filesystem::resize_file(large, (std::uintmax_t{64} << 20U) + 1U);
  expect_refusal([&] { static_cast<void>(read_weather(large)); }, "67108865 bytes");
}

// Cuts the file anywhere and changes any byte: reading must give weather or one error line.
TEST(WeatherAttack, CutAndChangedFiles) {
  const TempFolder folder;
  int refusals = 0;
  const auto attack = [&](const char* name, const std::string& bytes) {
    const std::filesystem::path file = folder.write(name, bytes);
    const auto message = message_of([&] { static_cast<void>(read_weather(file)); });
    if (!message) return;
    ++refusals;
    expect_three_parts(*message);
  };
  for (std::size_t length = 0; length < good_csv.size(); ++length) attack("a.csv", good_csv.substr(0, length));
  EXPECT_GT(refusals, 80);
  const std::string good = epw();
  for (std::size_t length = 0; length < 1500; length += 7) attack("a.epw", good.substr(0, length));
  for (std::size_t length = 1500; length < good.size(); length += 29989) attack("a.epw", good.substr(0, length));
  std::mt19937 random(20020808);
  const std::string alphabet = ",;:-+.TZ09ea#\n\r \"\xff\x01";
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = good_csv;
    for (unsigned edit = 0; edit <= random() % 3; ++edit) bytes[random() % bytes.size()] = alphabet[random() % alphabet.size()];
    attack("a.csv", bytes);
  }
  for (int round = 0; round < 40; ++round) {
    std::string bytes = good;
    const std::size_t within = round % 2 == 0 ? 400 : bytes.size();
    for (int edit = 0; edit < 3; ++edit) bytes[random() % within] = alphabet[random() % alphabet.size()];
    attack("a.epw", bytes);
  }
}

}  // namespace
}  // namespace sunfleck

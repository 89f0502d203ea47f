#include "simulate/day_plan.h"

#include "physics/light/sun_events.h"
#include "support/error_text.h"
#include "support/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sunfleck {
namespace {

class DayPlanTest : public SceneFolder {
 protected:
  [[nodiscard]] Scene scene_at(const std::string& time, const std::string& latitude = "40.02") const {
    return read("[plot]\nsize = [1, 1]\n[sun]\nlongitude = 10\nlatitude = " + latitude + "\ntime = " + time +
                    "\n[weather]\nclear_sky = \"ineichen\"\n[sky]\nmodel = \"uniform\"\n[[band]]\nname = \"PAR\"\n",
                {.purpose = ScenePurpose::day});
  }
  static DayRequest hours(const std::string& from, const std::string& to, int step_min) {
    DayRequest options;
    options.from = from;
    options.to = to;
    options.step_min = step_min;
    return options;
  }
};

TEST_F(DayPlanTest, LastStepEndsWithTheDay) {
  const DayPlan plan = plan_day(hours("9:30", "24:00", 60), scene_at("2003-12-31T00:10:00+03:30"));
  const auto& steps = plan.course.steps;
  ASSERT_EQ(steps.size(), 15U);
  EXPECT_EQ(local_time_text(steps[0].start, 210), "2003-12-31T09:30:00+03:30");
  EXPECT_EQ(local_time_text(steps[0].middle, 210), "2003-12-31T10:00:00+03:30");
  EXPECT_EQ(steps[0].length_s, 3600.0);
  EXPECT_EQ(local_time_text(steps[14].middle, 210), "2003-12-31T23:45:00+03:30");
  EXPECT_EQ(steps[14].length_s, 1800.0);
  EXPECT_TRUE(steps[14].unlit());
  EXPECT_FALSE(steps[2].unlit());
  EXPECT_EQ(plan.lights.size(), steps.size());
  EXPECT_TRUE(plan.lights[14].bands.empty());
  EXPECT_GT(plan.lights[2].bands.at(0).direct_w_m2, 0.0);
  EXPECT_EQ(plan.lights[2].sun.elevation_rad, steps[2].sun.elevation_rad);
}

TEST_F(DayPlanTest, CountsTheStepsWithoutWeather) {
  std::string csv = "time,ghi\n";
  for (int day = 8; day < 11; ++day) {
    for (int hour = 8; hour < 16; ++hour) {
      if (hour != 11 && !(day == 9 && hour == 13)) csv += fmt::format("2002-08-{:02}T{:02}:00:00+00:00,300\n", day, hour);
    }
  }
  write(folder_ / "station.csv", csv);
  const Scene scene = read(
      "[plot]\nsize = [1, 1]\n[sun]\nlongitude = 0\nlatitude = 40\ntime = 2002-08-08T10:10:00Z\n[weather]\nfile = "
      "\"station.csv\"\n[sky]\nmodel = \"uniform\"\n[[band]]\nname = \"PAR\"\n",
      {.purpose = ScenePurpose::day});
  DayRequest options = hours("9:00", "15:00", 60);
  options.to_date = "2002-08-10";
  const std::string message = refusal_of([&] { static_cast<void>(plan_day(options, scene)); });
  EXPECT_NE(message.find("has a gap there: nothing from 2002-08-08T11:00:00"), std::string::npos) << message;
  EXPECT_NE(message.find("the first of 4 such steps, the last begins at 2002-08-10T11:00:00"), std::string::npos) << message;
  options.to_date = "2002-08-08";
  EXPECT_EQ(refusal_of([&] { static_cast<void>(plan_day(options, scene)); }).find("such steps"), std::string::npos);
}

TEST_F(DayPlanTest, TellsOfLightThatNoStepHas) {
  std::string csv = "time,ghi\n";
  for (int hour = 2; hour < 22; ++hour)
    csv += fmt::format("2002-08-08T{:02}:00:00+00:00,{}\n", hour, hour < 6 || hour > 17 ? 20 : 400);
  write(folder_ / "station.csv", csv);
  const Scene scene = read(
      "[plot]\nsize = [1, 1]\n[sun]\nlongitude = 0\nlatitude = 40\ntime = 2002-08-08T10:10:00Z\n[weather]\nfile = "
      "\"station.csv\"\n[sky]\nmodel = \"uniform\"\n[[band]]\nname = \"PAR\"\n",
      {.purpose = ScenePurpose::day});
  // The sun rises at 05:05 and sets at 19:08 UTC: three hours before and three after have 20 W m-2.
  const std::vector<std::string> warnings = plan_warnings(plan_day(hours("02:00", "22:00", 60), scene), scene);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("station.csv: 2.42 % of its light"), std::string::npos) << warnings[0];
  EXPECT_TRUE(plan_warnings(plan_day(hours("06:00", "18:00", 60), scene), scene).empty());
  const Scene clear = scene_at("2002-08-08T10:10:00Z");
  EXPECT_TRUE(plan_warnings(plan_day(hours("02:00", "22:00", 60), clear), clear).empty());
}

TEST_F(DayPlanTest, DatesFollowTheCalendar) {
  DayRequest options = hours("11:00", "12:00", 10);
  options.date = "2004-02-28";
  options.to_date = "2004-03-01";
  const DayPlan plan = plan_day(options, scene_at("2002-08-08T10:10:00-11:00"));
  EXPECT_EQ(plan.course.dates, (std::vector<std::string>{"2004-02-28", "2004-02-29", "2004-03-01"}));
  ASSERT_EQ(plan.course.steps.size(), 18U);
  EXPECT_EQ(local_time_text(plan.course.steps[6].start, -660), "2004-02-29T11:00:00-11:00");
  EXPECT_EQ(plan.course.steps[17].date, 2U);
}

TEST_F(DayPlanTest, DateIsTheScenesOwnLocalOne) {
  // The scene's moment is 2002-08-07 21:30 UTC.
  const DayPlan plan = plan_day(hours("10:00", "11:00", 60), scene_at("2002-08-08T05:30:00+08:00"));
  EXPECT_EQ(plan.course.dates, std::vector<std::string>{"2002-08-08"});
}

TEST_F(DayPlanTest, DaylightIsRoundedOutwards) {
  for (const int step_min : {1, 10, 60}) {
    const DayPlan plan = plan_day(hours("", "", step_min), scene_at("2002-08-08T10:10:00+01:00"));
    EXPECT_EQ(plan.from_min % step_min, 0);
    EXPECT_EQ(plan.to_min % step_min, 0);
    const auto& steps = plan.course.steps;
    EXPECT_EQ(steps.size(), static_cast<std::size_t>((plan.to_min - plan.from_min) / step_min));
    const Place place{40.02 * std::acos(-1.0) / 180.0, std::acos(-1.0) / 18.0, 0.0};
    const UtcTime end = plus_seconds(steps.back().start, steps.back().length_s);
    for (const UtcTime& time : {steps.front().start, end}) {
      EXPECT_LT(sun_position(time, place).elevation_rad, 0.0);
    }
    // One step further in, the upper limb is up.
    EXPECT_GT(sun_position(steps[1].start, place).elevation_rad, rise_set_elevation_rad);
    EXPECT_GT(sun_position(steps.back().start, place).elevation_rad, rise_set_elevation_rad);
  }
}

// On a clock that is 12 hours off, the daylight lies at both ends of the date.
TEST_F(DayPlanTest, DaylightPastMidnightTakesTheWholeDate) {
  for (const char* offset : {"+13:00", "-11:00"}) {
    const DayPlan plan = plan_day(hours("", "", 60), scene_at(std::string("2002-08-08T10:10:00") + offset));
    EXPECT_EQ(plan.from_min, 0) << offset;
    EXPECT_EQ(plan.to_min, 1440) << offset;
  }
}

TEST_F(DayPlanTest, PolarDaysAndNights) {
  const DayPlan plan = plan_day(hours("", "", 60), scene_at("2002-06-21T10:10:00+01:00", "80"));
  EXPECT_EQ(plan.course.steps.size(), 24U);
  for (const DayStep& step : plan.course.steps) EXPECT_FALSE(step.unlit());
  const Scene winter = scene_at("2002-12-21T10:10:00+01:00", "80");
  expect_refusal([&] { static_cast<void>(plan_day(hours("", "", 60), winter)); });
  const DayPlan night = plan_day(hours("10:00", "14:00", 60), winter);
  for (const DayStep& step : night.course.steps) EXPECT_TRUE(step.unlit());
}

TEST_F(DayPlanTest, RefusalsAreOneLine) {
  const Scene scene = scene_at("2002-08-08T10:10:00+01:00");
  for (const char* time : {":", "7", "07:6", "007:00", "-1:00", "07:60", "24:30", "7:00:00", "07.00", " 7:00", "\n"}) {
    SCOPED_TRACE(time);
    expect_refusal([&] { static_cast<void>(plan_day(hours(time, "23:00", 60), scene)); });
  }
  for (const char* date : {"2002", "2002-8-8", "2002-13-01", "2001-02-29", "2101-01-01", "x", "2002/08/08", "2002-08-0\t"}) {
    SCOPED_TRACE(date);
    DayRequest options = hours("10:00", "11:00", 60);
    options.date = date;
    expect_refusal([&] { static_cast<void>(plan_day(options, scene)); });
  }
  expect_refusal([&] { static_cast<void>(plan_day(hours("23:00", "", 60), scene)); },
                 "--from 23:00 (the steps of these dates end at");
  expect_refusal([&] { static_cast<void>(plan_day(hours("", "01:00", 60), scene)); },
                 "--to 01:00 (the steps of these dates begin at");
  DayRequest many = hours("00:00", "24:00", 1);
  many.to_date = "2100-12-31";
  expect_refusal([&] { static_cast<void>(plan_day(many, scene)); });
}

}  // namespace
}  // namespace sunfleck

// Tests `day` over several dates through the program, and the planes and sensors of a day.

#include "regression/preload.h"
#include "regression/read_back.h"
#include "support/table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

const std::string scene_text = R"(title = "Three days of a station"
[plot]
size = [1.0, 1.25]
[sun]
time = 2002-08-08T10:10:00+08:00
latitude = 40.02
longitude = 116.28
[sky]
model = "perez"
[weather]
file = "station.csv"
[[band]]
name = "PAR"
share = 0.5
umol_per_joule = 4.57
[[band]]
name = "NIR"
share = 0.5
[soil]
reflectance = { PAR = 0.15, NIR = 0.25 }
[optics.leaf]
reflectance = { PAR = 0.12, NIR = 0.45 }
transmittance = { PAR = 0.06, NIR = 0.45 }
[optics.stem]
reflectance = { PAR = 0.12, NIR = 0.45 }
[[geometry]]
file = "leaves.obj"
optics = "leaf"
at = [[0, 0, 0], [0.3, 0.2, 0.3]]
[[geometry]]
file = "pole.obj"
optics = "stem"
at = [[0.8, 0, 0.9]]
[[plane]]
height = 0.3
cells = [4, 5]
[[sensor]]
name = "line"
from = [0.1, 0.2, 0.6]
to = [0.9, 0.2, 0.6]
points = 3
[[sensor]]
name = "ball"
from = [0.5, 0.4, 0.5]
response = "spherical"
[accuracy]
direct = 0.02
indirect = 0.02
)";

const std::string leaves = R"(o leaf
v 0.1 0.5 0.1
v 0.1 0.5 0.7
v 0.7 0.6 0.1
v 0.7 0.6 0.7
f 1 2 3
f 2 4 3
)";
const std::string pole = R"(o stem
v 0.0 0.0 0.0
v 0.1 0.0 0.0
v 0.0 0.5 0.0
v 0.1 0.5 0.0
f 1 2 3
f 2 4 3
)";

const std::array<const char*, 2> bands{"PAR", "NIR"};
const std::array<const char*, 3> kinds{"leaf", "stem", "soil"};

class Season : public PreloadTest {
 protected:
  void SetUp() override {
    folder_.write("leaves.obj", leaves);
    folder_.write("pole.obj", pole);
    std::string station = "time,ghi\n";
    for (int date = 7; date < 10; ++date) {
      for (int hour = 0; hour < 24; ++hour)  // the sun shines between 5 and 19 o'clock, and the last date is cloudy
        station += fmt::format("2002-08-{:02}T{:02}:00+08:00,{:.1f}\n", date, hour,
                               (date == 9 ? 200.0 : 800.0) * std::max(0.0, std::sin((hour - 4.7) / 14.8 * 3.14159)));
    }
    folder_.write("station.csv", station);
    folder_.write("scene.toml", scene_text);
  }

  [[nodiscard]] Outcome day(const Arguments& more, const std::string& to = "out") const {
    return run(Arguments{"day", "scene.toml", "-o", to, "--device", "cpu", "--images", "none"} + more);
  }
  void expect_day(const Arguments& more, int status = 0, const std::string& to = "out") const {
    const Outcome outcome = day(more, to);
    EXPECT_EQ(outcome.status, status) << outcome.err;
  }
  // Returns the results of a day, without the summary and the record of its steps.
  [[nodiscard]] Files results(const std::string& of) const {
    Files found = files(of);
    std::erase_if(found, [](const auto& file) { return file.first == "summary.json" || file.first.starts_with("steps/"); });
    return found;
  }

  const Arguments three_days_{"--date", "2002-08-07", "--to-date", "2002-08-09", "--from",
                              "08:00",  "--to",       "16:00",     "--step",     "120"};
  const Arguments one_day_{"--from", "10:00", "--to", "13:00"};
};

std::string column(const char* band, const std::string& name) {
  return std::string(band) + "_" + name;
}

TEST_F(Season, KindsOfOrgansShareWhatArrives) {
  expect_day(three_days_);
  EXPECT_FALSE(exists("day.nc")) << "several dates have it only if it is asked for";
  EXPECT_FALSE(exists("plane_0.300_day.nc"));
  const Table season(file("season.csv"));
  const Table sums(file("day_sums.csv"));
  const Table organs(file("organs_day.csv"));
  ASSERT_EQ(season.size(), 9U);
  ASSERT_EQ(sums.size(), 3U);
  for (std::size_t date = 0; date < 3; ++date) {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      EXPECT_EQ(season.cell(3 * date + kind, "date"), sums.cell(date, "date"));
      EXPECT_EQ(season.cell(3 * date + kind, "organ"), kinds.at(kind));
    }
    const std::size_t leaf = 3 * date, soil = leaf + 2;
    EXPECT_EQ(season.cell(leaf, "organs"), "2");
    for (const char* band : bands) {
      const std::string absorbed = column(band, "absorbed_ground_mj_m2");
      const double vegetation = season.number(leaf, absorbed) + season.number(leaf + 1, absorbed);
      EXPECT_NEAR(vegetation / sums.number(date, column(band, "absorbed_vegetation_mj_m2")), 1.0, 1e-7);
      for (const char* of : {"", "_error"}) {
        EXPECT_EQ(season.cell(soil, absorbed + of), sums.cell(date, column(band, "absorbed_soil_mj_m2") + of));
      }
      // The error of a kind follows from the spread of its own sum: what one leaf receives the next one misses.
      double mj = 0.0, largest_mj = 0.0;
      for (std::size_t o = 0; o < organs.size() / 3; ++o) {
        const std::size_t row = date * organs.size() / 3 + o;
        if (organs.cell(row, "organ") != "leaf") continue;
        mj += organs.number(row, column(band, "absorbed_mj_m2")) * organs.number(row, "area_m2") / 1.25;
        largest_mj += organs.number(row, column(band, "absorbed_mj_m2_error")) * organs.number(row, "area_m2") / 1.25;
      }
      EXPECT_NEAR(season.number(leaf, absorbed) / mj, 1.0, 1e-7);
      EXPECT_LE(season.number(leaf, absorbed + "_error"), largest_mj * (1.0 + 1e-7));
      EXPECT_GT(season.number(leaf, absorbed + "_error"), 0.1 * largest_mj);
      EXPECT_NEAR(season.number(leaf, column(band, "absorbed_share")) * sums.number(date, column(band, "incident_mj_m2")), mj,
                  1e-7);
      EXPECT_NEAR(season.number(leaf, column(band, "absorbed_mj_m2")) * season.number(leaf, "area_index"), mj, 1e-7);
    }
    EXPECT_NEAR(season.number(leaf, "PAR_absorbed_ground_mol_m2") / season.number(leaf, "PAR_absorbed_ground_mj_m2"), 4.57,
                1e-6);
  }
  EXPECT_LT(sums.number(2, "PAR_incident_mj_m2"), 0.5 * sums.number(0, "PAR_incident_mj_m2")) << "the cloudy date";
}

TEST_F(Season, OrgansHaveEveryStep) {
  expect_day(three_days_ + Arguments{"--export", "nc"});
  const json found = read_back("season", folder_ / "out/organs_steps.nc");
  ASSERT_FALSE(found.is_discarded()) << "python3-netcdf4 and python3-xarray must be installed";
  const Table organs(file("organs_day.csv"));
  const std::size_t count = organs.size() / 3;
  EXPECT_EQ(found["sizes"]["time"], 12);
  EXPECT_EQ(found["sizes"]["organ"], count);
  EXPECT_EQ(found["starts"][0], "2002-08-07T00:00:00");
  EXPECT_EQ(found["starts"][11], "2002-08-09T06:00:00");
  EXPECT_EQ(found["conventions"], "CF-1.8");
  for (const char* name : {"plant", "rank", "area_m2", "organ_name", "role"})
    EXPECT_NE(std::find(found["coordinates"].begin(), found["coordinates"].end(), name), found["coordinates"].end()) << name;
  for (std::size_t o = 0; o < count; ++o) {
    EXPECT_EQ(found["organs"][o], organs.cell(o, "organ"));
    EXPECT_EQ(found["roles"][o], organs.cell(o, "role"));
    for (const char* band : bands) {
      double mj = 0.0;
      for (std::size_t date = 0; date < 3; ++date) mj += organs.number(date * count + o, column(band, "absorbed_mj_m2"));
      EXPECT_NEAR(1e-6 * found["sums"][column(band, "absorbed")][o].get<double>() / mj, 1.0, 1e-5);  // single precision
      EXPECT_GT(found["sums"][column(band, "absorbed_error")][o], 0.0);
    }
  }
  EXPECT_TRUE(exists("day.nc"));
  const json maps = read_back("season", folder_ / "out/plane_0.300_day.nc");
  ASSERT_FALSE(maps.is_discarded());
  EXPECT_EQ(maps["sizes"], json({{"time", 12}, {"bound", 2}, {"x_m", 4}, {"z_m", 5}}));
  const Table sums(file("plane_0.300_day.csv"));
  ASSERT_EQ(sums.size(), 20U);
  for (std::size_t cell = 0; cell < sums.size(); ++cell) {
    EXPECT_NEAR(1e-6 * maps["sums"]["NIR_total"][cell].get<double>(), sums.number(cell, "NIR_total_mj_m2"), 1e-5);
    EXPECT_NEAR(maps["sums"]["sunfleck"][cell].get<double>() / 3600.0, sums.number(cell, "sunlit_h"), 1e-4);
  }
}

TEST_F(Season, ReadingsOfAStepAreThoseOfItsMoment) {
  expect_day({"--from", "09:00", "--to", "13:00", "--step", "60", "--seed", "5"});  // hours of the weather
  std::string text = scene_text;
  text.replace(text.find("T10:10"), 6, "T11:30");
  folder_.write("moment.toml", text);
  simulate("moment.toml", {"--device", "cpu", "--images", "none"}, 0, "single");
  const Table points(file("sensors_day.csv")), moment(file("sensors.csv", "single"));
  const Table means(file("sensor_means_day.csv")), mean(file("sensor_means.csv", "single"));
  const Table planes(file("planes_day.csv"));
  ASSERT_EQ(moment.size(), 4U);
  ASSERT_EQ(points.size(), 4U * moment.size());
  ASSERT_EQ(means.size(), 8U);
  constexpr std::size_t step = 2;
  EXPECT_EQ(points.cell(4 * step, "time"), "2002-08-08T11:00:00+08:00");
  // Independent estimates; 2.2 of their joint intervals are more than four standard errors, for some forty figures.
  const auto expect_near = [](const Table& of_day, std::size_t row, const Table& alone, std::size_t its_row,
                              const std::string& name) {
    const double error = std::hypot(of_day.number(row, name + "_error"), alone.number(its_row, name + "_error"));
    EXPECT_NEAR(of_day.number(row, name), alone.number(its_row, name), 2.2 * error + 1e-6) << name << ", row " << its_row;
  };
  for (const char* band : bands) {
    for (const char* part : {"direct", "sky", "scattered", "total"}) {
      for (std::size_t p = 0; p < 4; ++p) {
        EXPECT_EQ(points.cell(4 * step + p, "sensor"), moment.cell(p, "sensor"));
        EXPECT_EQ(points.cell(4 * step + p, "x"), moment.cell(p, "x"));
        expect_near(points, 4 * step + p, moment, p, column(band, part));
      }
      for (std::size_t s = 0; s < 2; ++s) expect_near(means, 2 * step + s, mean, s, column(band, part));
    }
    // The flux through the plane: the mean of the cells of the map.
    const Table map(file("plane_0.300.csv", "single"));
    double down = 0.0;
    for (std::size_t cell = 0; cell < map.size(); ++cell) down += map.number(cell, column(band, "total")) / 20.0;
    EXPECT_NEAR(planes.number(step, column(band, "down")), down, 3.0 * planes.number(step, column(band, "down_error")));
  }
  EXPECT_EQ(planes.number(step, "height_m"), 0.3);
  EXPECT_GT(planes.number(step, "sunfleck_ratio"), 0.1);
  EXPECT_LT(planes.number(step, "sunfleck_ratio"), 0.9);
}

TEST_F(Season, SumsOfReceiversAreThoseOfTheirSteps) {
  expect_day(three_days_);
  const Table means(file("sensor_means_day.csv")), sums(file("sensor_day_sums.csv"));
  const Table planes(file("planes_day.csv")), plane_sums(file("plane_day_sums.csv")), map(file("plane_0.300_day.csv"));
  ASSERT_EQ(means.size(), 24U);
  ASSERT_EQ(sums.size(), 6U);
  ASSERT_EQ(planes.size(), 12U);
  for (const char* band : bands) {
    double through = 0.0;
    for (std::size_t date = 0; date < 3; ++date) {
      for (std::size_t s = 0; s < 2; ++s) {
        double mj = 0.0, squares = 0.0;
        for (std::size_t step = 4 * date; step < 4 * date + 4; ++step) {
          mj += 7200e-6 * means.number(2 * step + s, column(band, "total"));
          squares += std::pow(7200e-6 * means.number(2 * step + s, column(band, "total_error")), 2);
        }
        EXPECT_NEAR(sums.number(2 * date + s, column(band, "total_mj_m2")) / mj, 1.0, 1e-7);
        EXPECT_NEAR(sums.number(2 * date + s, column(band, "total_mj_m2_error")) / std::sqrt(squares), 1.0, 1e-6);
      }
      double mj = 0.0;
      for (std::size_t step = 4 * date; step < 4 * date + 4; ++step) mj += 7200e-6 * planes.number(step, column(band, "down"));
      EXPECT_NEAR(plane_sums.number(date, column(band, "down_mj_m2")) / mj, 1.0, 1e-7);
      through += mj;
    }
    double of_cells = 0.0;
    for (std::size_t cell = 0; cell < map.size(); ++cell) of_cells += map.number(cell, column(band, "total_mj_m2")) / 20.0;
    EXPECT_NEAR(of_cells / through, 1.0, 1e-5) << "single precision";
  }
  EXPECT_NEAR(sums.number(0, "PAR_total_mol_m2") / sums.number(0, "PAR_total_mj_m2"), 4.57, 1e-6);
  // Without a beam on the cloudy date, the sun shines for 16 hours.
  EXPECT_EQ(map.comments().back(), "# dates 3, steps 12, hours with a direct beam 16");
  for (std::size_t cell = 0; cell < map.size(); ++cell)
    EXPECT_NEAR(map.number(cell, "sunlit_h"), 16.0 * map.number(cell, "sunlit_share"), 1e-6);
}

// Under a sky that stays the same, the readings below a leaf differ between steps by as much as their errors say, also within the
// blocks of steps that share packets.
TEST_F(Season, SensorsMeasureEachStepWithRaysOfTheirOwn) {
  std::string text = scene_text;
  const auto replace = [&](const std::string& from, const std::string& by) { text.replace(text.find(from), from.size(), by); };
  replace("model = \"perez\"", "model = \"cie-overcast\"");
  replace("[weather]\nfile = \"station.csv\"\n", "");
  for (int band = 0; band < 2; ++band) replace("share = 0.5", "direct_normal = 1\ndiffuse = 100");
  replace("[0.5, 0.4, 0.5]", "[0.3, 0.45, 0.3]");
  folder_.write("scene.toml", text);
  expect_day({"--from", "06:00", "--to", "18:00"});
  const Table readings(file("sensors_day.csv"));
  ASSERT_EQ(readings.size(), 12U * 4U);
  double mean = 0.0, squares = 0.0, of_errors = 0.0;
  for (std::size_t row = 3; row < readings.size(); row += 4) mean += readings.number(row, "PAR_sky") / 12.0;
  for (std::size_t row = 3; row < readings.size(); row += 4) {
    ASSERT_EQ(readings.cell(row, "sensor"), "ball");
    squares += std::pow(readings.number(row, "PAR_sky") - mean, 2);
    of_errors += std::pow(readings.number(row, "PAR_sky_error"), 2);
  }
  // A half-width is about 2.2 standard errors.
  EXPECT_GT(std::sqrt(squares / of_errors), 0.25);
  EXPECT_LT(std::sqrt(squares / of_errors), 0.8);
}

TEST_F(Season, GoesOnWhereItWasKilled) {
  const Arguments asked = three_days_ + Arguments{"--export", "nc"};
  expect_day(asked, 0, "whole");
  may_be_killed_ = true;
  // The kills come when a step of the second date is renamed, and while tables and netCDF files are written.
  preload_signals(signal_at(SIGKILL, "rename steps/step_", 6));
  expect_day(asked, -1);
  preload_signals(signal_at(SIGKILL, "write steps/step_season.csv.tmp", 2));
  expect_day(asked + Arguments{"--resume"}, -1);
  may_be_killed_ = false;
  preload_nothing();
  expect_day(asked + Arguments{"--resume"});
  const Files whole = results("whole"), resumed = results("out");
  EXPECT_EQ(whole.size(), 14U);
  EXPECT_EQ(whole.size(), resumed.size());
  for (const auto& [name, bytes] : whole) EXPECT_TRUE(resumed.contains(name) && resumed.at(name) == bytes) << name;
}

TEST_F(Season, CtrlCKeepsWholeAndBrokenDates) {
  expect_day(three_days_, 0, "whole");
  preload_signals(signal_at(SIGINT, "rename steps/step_", 6));
  expect_day(three_days_, 130);
  preload_nothing();
  const Table sums(file("day_sums.csv"));
  ASSERT_EQ(sums.size(), 2U);
  EXPECT_EQ(sums.number(0, "steps"), 4.0);
  EXPECT_LT(sums.number(1, "steps"), 4.0);
  EXPECT_EQ(Table(file("season.csv")).size(), 6U);
  EXPECT_TRUE(Table(file("season.csv")).comments().back().starts_with("# incomplete: the first "));
  expect_day(three_days_ + Arguments{"--resume"});
  const Files whole = results("whole"), resumed = results("out");
  for (const auto& [name, bytes] : whole) EXPECT_TRUE(resumed.contains(name) && resumed.at(name) == bytes) << name;
}

TEST_F(Season, IsNotLostToARunInItsFolder) {
  const Arguments quick{"run",      "scene.toml", "-o",       "out", "--device", "cpu",
                        "--images", "none",       "--passes", "800", "--error",  "0.1"};
  const auto expect_refused = [](const Outcome& outcome, const std::string& why) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  preload_signals(signal_at(SIGINT, "rename steps/step_", 2));
  expect_day(one_day_, 130);
  preload_nothing();
  const Files kept = files("out");
  expect_refused(run(quick),
                 "out (it holds an unfinished day, which a run would replace); finish it with `sunfleck day --resume`");
  EXPECT_EQ(files("out"), kept);
  expect_day(one_day_ + Arguments{"--resume"});

  preload_signals(signal_at(SIGINT, "rename run_state.bin", 1), {{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const Outcome stopped = run(quick);
  preload_nothing();
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_NE(stopped.err.find("warning: out: this run replaces the result of another command there"), std::string::npos)
      << stopped.err;
  EXPECT_FALSE(exists("day.csv"));
  expect_refused(day(one_day_),
                 "out (it holds an unfinished run, which a day would replace); finish it with `sunfleck run --resume`");
  EXPECT_EQ(run(quick + Arguments{"--resume"}).status, 0);
}

// The light of triangles, which several dates do not have, changes nothing else.
TEST_F(Season, FieldsOfTrianglesAreOnlyAdded) {
  expect_day(three_days_, 0, "without");
  expect_day(three_days_ + Arguments{"--export", "nc"});
  for (const auto& [name, bytes] : results("without")) EXPECT_TRUE(file(name) == bytes) << name;
}

TEST_F(Season, DrawsKindsAndMaps) {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = run(Arguments{"day", "scene.toml", "-o", "out", "--device", "cpu", "--band", "NIR"} + three_days_);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"day.png", "season.png", "plane_0.300_day.png"}) EXPECT_EQ(file(name).substr(1, 3), "PNG") << name;
  EXPECT_NE(outcome.err.find("date 3 of 3"), std::string::npos) << outcome.err;
  expect_day(one_day_);
  for (const char* name : {"day.png", "season.png", "plane_0.300_day.png"}) EXPECT_FALSE(exists(name)) << name;
}

// A year of half-hourly steps is planned, and --max-seconds ends it before its first step.
TEST_F(Season, MayBeAYear) {
  std::string text = scene_text;
  text.replace(text.find("file = \"station.csv\""), 20, "clear_sky = \"ineichen\"");
  folder_.write("scene.toml", text);
  const Arguments year{"--date", "2003-01-01", "--to-date", "2003-12-31", "--from", "00:00", "--to", "24:00", "--step", "30"};
  expect_day(year + Arguments{"--max-seconds", "1e-9"}, 1);
  EXPECT_EQ(summary()["steps"]["asked"], 17520);
}

// A step of the night takes no time, and a step of the day little with so few rays: the peaks differ by what is kept.
TEST_F(Season, MemoryDoesNotGrowWithItsDates) {
  std::string text = scene_text;
  text.replace(text.find("file = \"station.csv\""), 20, "clear_sky = \"ineichen\"");
  text.replace(text.find("cells = [4, 5]"), 14, "cells = [200, 250]");  // 1 MB of maps at each step
  folder_.write("scene.toml", text);
  const auto peak_mib = [&](const std::string& last, const std::string& to) {
    const Outcome outcome = day({"--date", "2003-07-01", "--to-date", last, "--from", "09:00", "--to", "15:00", "--step", "60",
                                 "--grid", "0.02", "--passes", "8", "--threads", "1"},
                                to);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.peak_mib;
  };
  const double few = peak_mib("2003-07-02", "few");
  EXPECT_LT(peak_mib("2003-07-12", "many"), few + 8.0) << "60 more steps have 60 MB of maps";
}

}  // namespace
}  // namespace sunfleck::regression

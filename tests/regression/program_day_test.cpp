// Tests `day` through the program: its tables, and that an interrupted day resumes with the same results.

#include "regression/preload.h"
#include "regression/read_back.h"
#include "support/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

const std::string scene_text = R"(title = "A small day"
[plot]
size = [1.0, 1.25]
[sun]
time = 2002-08-08T10:10:00+08:00
latitude = 40.02
longitude = 116.28
[sky]
model = "perez"
[weather]
clear_sky = "ineichen"
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
[[geometry]]
file = "leaves.obj"
optics = "leaf"
at = [[0, 0, 0], [0.3, 0.2, 0.3]]
[accuracy]
direct = 0.02
indirect = 0.02
)";

const std::string leaves = R"(v 0.1 0.5 0.1
v 0.1 0.5 0.7
v 0.7 0.6 0.1
v 0.7 0.6 0.7
f 1 2 3
f 2 4 3
)";

constexpr double day_plot_m2 = 1.25;
const std::array<const char*, 2> bands{"PAR", "NIR"};
const std::array<const char*, 6> terms{"incident",      "absorbed_vegetation", "absorbed_structure",
                                       "absorbed_soil", "reflected",           "transmitted"};
const std::array<const char*, 5> tables{"day.csv", "day_sums.csv", "organs_day.csv", "plants_day.csv", "day.nc"};

class Day : public PreloadTest {
 protected:
  void SetUp() override {
    folder_.write("leaves.obj", leaves);
    scene_ = folder_.write("scene.toml", scene_text).string();
  }

  [[nodiscard]] Outcome day(const Arguments& more, const std::string& to = "out") const {
    const bool drawn = std::find(more.begin(), more.end(), "--images") != more.end();
    const Arguments images = drawn ? Arguments{} : Arguments{"--images", "none"};
    return run(Arguments{"day", scene_, "-o", to, "--device", "cpu"} + images + more);
  }
  void expect_day(const Arguments& more, int status = 0, const std::string& to = "out") const {
    const Outcome outcome = day(more, to);
    EXPECT_EQ(outcome.status, status) << outcome.err;
  }
  void expect_same_tables(const std::string& left, const std::string& right) const {
    for (const char* name : tables) {
      EXPECT_FALSE(file(name, left).empty()) << name;
      EXPECT_TRUE(file(name, left) == file(name, right)) << name << " of " << left << " and " << right;
    }
  }
  [[nodiscard]] std::size_t finished_steps(const std::string& of = "out") const {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / of / "steps", error)) {
      const std::string name = entry.path().filename().string();
      count += name.starts_with("step_") && name.ends_with(".bin") ? 1 : 0;
    }
    return count;
  }
  // Sends Ctrl-C to a day when the `steps`-th step is stored; the next step is being simulated then.
  void interrupt_evening(int steps) {
    preload_signals(signal_at(SIGINT, "rename steps/step_", steps));
    expect_day(evening_, 130);
    preload_nothing();
  }
  // Kills a day at these events, with or without the steps it had stored.
  void kill_day(const Arguments& more, const std::string& signals) {
    preload_signals(signals);
    may_be_killed_ = true;
    expect_day(more, -1);
    may_be_killed_ = false;
    preload_nothing();
  }
  [[nodiscard]] json read_fields() const { return read_back("day", folder_ / "out/day.nc"); }

  // One by one, steps are stored as soon as each is done.
  const Arguments one_by_one_{"--together", "1"};
  const Arguments evening_{"--from", "15:00", "--to", "20:20", "--together", "1"};
  std::string scene_;
};

std::string column(const char* band, const std::string& name) {
  return std::string(band) + "_" + name;
}

TEST_F(Day, TablesAreAsTheManualSays) {
  expect_day(evening_);
  const Table day(file("day.csv"));
  std::string header = "time,step_s,elevation_deg,azimuth_deg";
  for (const char* band : bands) {
    for (const char* term : terms) header += ',' + column(band, term) + ',' + column(band, term) + "_error";
  }
  header +=
      ",sunlit_leaf_fraction,sunlit_leaf_fraction_error,sunlit_leaf_area_index,sunlit_leaf_area_index_error,"
      "shaded_leaf_area_index,shaded_leaf_area_index_error";
  for (const char* band : bands) {
    for (const char* part : {"_sunlit", "_sunlit_sd", "_shaded", "_shaded_sd"}) {
      for (const char* unit : {"", "_umol_m2_s"}) {
        if (*unit != '\0' && std::string(band) != "PAR") continue;
        header += ',' + column(band, "absorbed") + part + unit + ',' + column(band, "absorbed") + part + unit + "_error";
      }
    }
  }
  for (const char* band : bands) header += ',' + column(band, "unshot");
  EXPECT_EQ(day.header(), header);
  ASSERT_EQ(day.size(), 6U);
  EXPECT_EQ(day.cell(0, "time"), "2002-08-08T15:00:00+08:00");
  EXPECT_EQ(day.number(0, "step_s"), 3600.0);
  EXPECT_EQ(day.cell(5, "time"), "2002-08-08T20:00:00+08:00");
  EXPECT_EQ(day.number(5, "step_s"), 1200.0);
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_GT(day.number(row, "elevation_deg"), 0.0);
    EXPECT_EQ(day.number(row, "PAR_incident_error"), 0.0);
    for (const char* term : {"incident", "absorbed_vegetation", "absorbed_soil", "reflected"}) {
      EXPECT_GT(day.number(row, column("PAR", term)), 0.0);
    }
    for (const char* figure : {"PAR_absorbed_structure", "PAR_absorbed_structure_error"}) EXPECT_EQ(day.cell(row, figure), "0");
    double left = day.number(row, "PAR_incident") - day.number(row, "PAR_unshot");
    for (const char* term : {"absorbed_vegetation", "absorbed_structure", "absorbed_soil", "reflected", "transmitted"})
      left -= day.number(row, column("PAR", term));
    EXPECT_NEAR(left, 0.0, 1e-8 * day.number(row, "PAR_incident")) << "what arrived has gone somewhere";
  }
  for (std::size_t row = 4; row < 6; ++row) {  // sunset is at 19:17
    EXPECT_LT(day.number(row, "elevation_deg"), 0.0);
    for (std::size_t c = 4; c < day.columns().size(); ++c) {
      const std::string& name = day.columns()[c];
      if (name == "shaded_leaf_area_index") continue;
      const bool needs_beam = name.starts_with("sunlit_leaf_fraction") || name.find("_absorbed_sunlit") != name.npos;
      EXPECT_EQ(day.cell(row, name), needs_beam ? "" : "0") << name;
    }
    EXPECT_GT(day.number(row, "shaded_leaf_area_index"), 0.0);
  }
  const Table organs(file("organs_day.csv"));
  EXPECT_EQ(
      organs.header(),
      "date,plant,organ,rank,area_m2,PAR_absorbed_mj_m2,PAR_absorbed_mj_m2_error,PAR_absorbed_mol_m2,PAR_absorbed_mol_m2_error,"
      "NIR_absorbed_mj_m2,NIR_absorbed_mj_m2_error,role");
  EXPECT_EQ(organs.size(), 2U);
  const Table plants(file("plants_day.csv"));
  ASSERT_EQ(plants.size(), 2U);
  for (std::size_t row = 0; row < 2; ++row) {
    for (const char* band : bands) {
      const double mj = organs.number(row, column(band, "absorbed_mj_m2")) * organs.number(row, "area_m2");
      EXPECT_NEAR(plants.number(row, column(band, "absorbed_mj")) / mj, 1.0, 1e-7);
      EXPECT_GT(plants.number(row, column(band, "absorbed_mj_error")), 0.0);
    }
  }
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_EQ(summary()["steps"], json({{"asked", 6}, {"done", 6}, {"night", 2}, {"short_of_bound", 0}}));
}

// The second copy of the leaves is a structure.
TEST_F(Day, KeepsStructuresApart) {
  std::string text = scene_text;
  const std::string copies = "at = [[0, 0, 0], [0.3, 0.2, 0.3]]\n";
  const std::string panel =
      "[[geometry]]\nfile = \"leaves.obj\"\noptics = \"leaf\"\nrole = \"structure\"\nat = [[0.3, 0.2, 0.3]]\n";
  text.replace(text.find(copies), copies.size(), panel);
  folder_.write("scene.toml", text);
  expect_day({"--from", "10:00", "--to", "12:00"});
  const Table day(file("day.csv"));
  const Table organs(file("organs_day.csv"));
  ASSERT_EQ(organs.size(), 2U);
  EXPECT_EQ(organs.cell(0, "role"), "leaf");
  EXPECT_EQ(organs.cell(1, "role"), "structure");
  for (std::size_t b = 0; b < bands.size(); ++b) {
    double structure_mj = 0.0;
    for (std::size_t row = 0; row < day.size(); ++row) {
      double rest = day.number(row, column(bands[b], "incident"));
      double unshot = std::numeric_limits<double>::infinity();  // is part of every error
      for (std::size_t t = 1; t < terms.size(); ++t) {
        rest -= day.number(row, column(bands[b], terms[t]));
        unshot = std::min(unshot, day.number(row, column(bands[b], terms[t]) + "_error"));
      }
      EXPECT_GT(day.number(row, column(bands[b], "absorbed_structure")), 10.0);
      EXPECT_GT(rest, -1e-6);
      EXPECT_LT(rest, unshot + 1e-6);
      structure_mj += 1e-6 * day.number(row, "step_s") * day.number(row, column(bands[b], "absorbed_structure")) * day_plot_m2;
    }
    EXPECT_NEAR(organs.number(1, column(bands[b], "absorbed_mj_m2")) * organs.number(1, "area_m2") / structure_mj, 1.0, 1e-7);
    const json sums = summary()["dates"][0]["bands"][b];
    EXPECT_NEAR(sums["absorbed_structure_mj_m2"].get<double>() * day_plot_m2 / structure_mj, 1.0, 1e-7);
  }
}

TEST_F(Day, StepIsTheRunOfItsMiddle) {
  expect_day({"--from", "08:40", "--to", "12:40", "--step", "60", "--seed", "5"});
  std::string text = scene_text;
  text.replace(text.find("T10:10"), 6, "T11:10");
  folder_.write("scene.toml", text);
  simulate(scene_, {"--device", "cpu", "--images", "none"}, 0, "single");
  const Table day(file("day.csv"));
  const json single = summary("single");
  EXPECT_NEAR(day.number(2, "elevation_deg"), single["sun"]["elevation_deg"], 1e-6);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const json& band = single["bands"][b];
    EXPECT_NEAR(day.number(2, column(bands[b], "incident")), band["incident"], 1e-6);
    for (const char* term : {"absorbed_vegetation", "absorbed_soil", "reflected"}) {
      // Independent estimates; twice their intervals is four standard errors.
      const double error = std::hypot(day.number(2, column(bands[b], term) + "_error"), band["error"][term].get<double>());
      EXPECT_NEAR(day.number(2, column(bands[b], term)), band[term], 2.0 * error) << bands[b] << ' ' << term;
    }
  }
}

TEST_F(Day, LampsShineAtNight) {
  std::string text = scene_text +
                     "[optics.lamp]\nrole = \"lamp\"\nreflectance = 0.1\nemission = { PAR = 200.0, NIR = 50.0 }\n"
                     "[[geometry]]\nfile = \"leaves.obj\"\noptics = \"lamp\"\nat = [[0.1, 0.1, 1.0]]\n";
  folder_.write("scene.toml", text);
  expect_day({"--from", "00:00", "--to", "08:00", "--step", "120"});
  text.replace(text.find("T10:10"), 6, "T03:00");
  folder_.write("scene.toml", text);
  simulate(scene_, {"--device", "cpu", "--images", "none", "--seed", "7"}, 0, "single");
  const Table day(file("day.csv"));
  const json single = summary("single");
  ASSERT_EQ(day.size(), 4U);
  ASSERT_LT(day.number(1, "elevation_deg"), 0.0);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const json& band = single["bands"][b];
    EXPECT_GT(band["incident"].get<double>(), 1.0);
    for (const char* term : terms) {
      const double error = std::hypot(day.number(1, column(bands[b], term) + "_error"), band["error"].value(term, 0.0));
      EXPECT_NEAR(day.number(1, column(bands[b], term)), band[term].get<double>(), 2.0 * error + 1e-6)
          << bands[b] << ' ' << term;
    }
    EXPECT_EQ(day.number(0, column(bands[b], "incident")), day.number(1, column(bands[b], "incident")));
    EXPECT_GT(day.number(3, column(bands[b], "incident")), day.number(1, column(bands[b], "incident")) + 1.0);
  }
  EXPECT_EQ(summary()["steps"]["night"].get<int>(), 0);
}

TEST_F(Day, IntegralsAreSumsOverTheStepsOfEachDate) {
  expect_day({"--from", "10:30", "--to", "13:00", "--date", "2003-06-30", "--to-date", "2003-07-01"});
  const Table day(file("day.csv"));
  const Table organs(file("organs_day.csv"));
  ASSERT_EQ(day.size(), 6U);
  ASSERT_EQ(organs.size(), 4U);
  EXPECT_EQ(day.cell(3, "time"), "2003-07-01T10:30:00+08:00");
  for (std::size_t date = 0; date < 2; ++date) {
    EXPECT_EQ(organs.cell(2 * date, "date"), date == 0 ? "2003-06-30" : "2003-07-01");
    for (const char* band : bands) {
      double mj = 0.0, organs_mj = 0.0;
      for (std::size_t row = 3 * date; row < 3 * date + 3; ++row) {
        mj += 1e-6 * day.number(row, "step_s") * day.number(row, column(band, "absorbed_vegetation")) * day_plot_m2;
      }
      for (std::size_t row = 2 * date; row < 2 * date + 2; ++row) {
        organs_mj += organs.number(row, column(band, "absorbed_mj_m2")) * organs.number(row, "area_m2");
        const double error = organs.number(row, column(band, "absorbed_mj_m2_error"));
        EXPECT_GT(error, 0.0);
        EXPECT_LT(error, 0.02 * organs.number(row, column(band, "absorbed_mj_m2")));
      }
      EXPECT_NEAR(organs_mj / mj, 1.0, 1e-7) << band;
      const json sums = summary()["dates"][date]["bands"][band == bands[0] ? 0 : 1];
      EXPECT_NEAR(sums["absorbed_vegetation_mj_m2"].get<double>() * day_plot_m2 / mj, 1.0, 1e-7);
      if (sums.contains("absorbed_vegetation_mol_m2")) {
        const double mj_error = sums["error"]["absorbed_vegetation_mj_m2"];
        EXPECT_NEAR(sums["error"]["absorbed_vegetation_mol_m2"].get<double>() / mj_error, 4.57, 1e-6);
      }
    }
    const double mol = organs.number(2 * date, "PAR_absorbed_mol_m2");
    EXPECT_NEAR(mol / organs.number(2 * date, "PAR_absorbed_mj_m2"), 4.57, 1e-6);
  }
}

TEST_F(Day, FieldsAreReadByXarray) {
  expect_day(evening_);
  const Table day(file("day.csv"));
  const json found = read_fields();
  ASSERT_FALSE(found.is_discarded()) << "python3-netcdf4 and python3-xarray must be installed";
  EXPECT_EQ(found["sizes"], json({{"time", 6}, {"triangle", 4}}));
  EXPECT_EQ(found["starts"][0], "2002-08-08T07:00:00");
  EXPECT_EQ(found["ends"][5], "2002-08-08T12:20:00");
  EXPECT_EQ(found["local"][5], "2002-08-08T20:00:00+08:00");
  EXPECT_EQ(found["conventions"], "CF-1.8");
  for (const char* band : bands) {
    for (std::size_t step = 0; step < day.size(); ++step) {
      const double absorbed = day.number(step, column(band, "absorbed_vegetation"));
      EXPECT_NEAR(found["absorbed_w"][band][step].get<double>() / day_plot_m2, absorbed, 1e-5 * absorbed);
    }
    EXPECT_EQ(found["columns"][band], json({"absorbed", "absorbed_error", "direct_lower", "direct_upper", "indirect_lower",
                                            "indirect_upper", "sky_lower", "sky_upper"}));
  }
}

TEST_F(Day, LeavesOutTheLightOfTrianglesIfTold) {
  const Arguments morning{"--from", "10:00", "--to", "12:00"};
  const Arguments without = morning + Arguments{"--export", "none"};
  expect_day(morning);
  expect_day(without, 0, "without");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/day.nc"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "without/day.nc"));
  for (const char* name : {"day.csv", "day_sums.csv", "organs_day.csv", "plants_day.csv"})
    EXPECT_EQ(file(name, "without"), file(name)) << name;
  expect_day(without + Arguments{"--resume"}, 0, "without");
  expect_one_error(day(morning + Arguments{"--resume"}, "without"), 2,
                   "the light of triangles for --export and --images was false, now true");
}

TEST_F(Day, GoesOnWhereItWasKilled) {
  expect_day(one_by_one_, 0, "whole");
  // The kills come when a step is renamed, before a step is written, and while the next one is simulated.
  kill_day(one_by_one_, signal_at(SIGKILL, "rename steps/step_", 2));
  EXPECT_EQ(finished_steps(), 1U);
  kill_day({"--resume"}, signal_at(0, "rename steps/step_", 3) + "," + signal_at(SIGKILL, "write steps/step_"));
  EXPECT_EQ(finished_steps(), 4U);
  kill_day({"--resume"}, signal_at(0, "rename steps/step_", 5) + "," + signal_at(SIGKILL, "clock", 5));
  EXPECT_GE(finished_steps(), 8U);
  expect_day({"--resume"});
  expect_same_tables("whole", "out");
  EXPECT_EQ(finished_steps(), 0U);
}

// Steps that share packets have the light of steps simulated one by one, within the errors of both; a killed day resumes with
// blocks of the size it had.
TEST_F(Day, SimulatesStepsTogether) {
  const Arguments together{"--together", "4"};
  expect_day(one_by_one_, 0, "single");
  expect_day(together, 0, "whole");
  const Table single(file("day.csv", "single")), shared(file("day.csv", "whole"));
  ASSERT_EQ(single.size(), shared.size());
  for (std::size_t step = 0; step < single.size(); ++step) {
    for (const char* band : bands) {
      for (const char* term : terms) {
        const auto number = [&](const Table& table, const char* end) { return table.number(step, column(band, term) + end); };
        // Three half-widths of 95 % are 5.9 standard errors.
        const double limit = 3.0 * std::hypot(number(single, "_error"), number(shared, "_error"));
        EXPECT_NEAR(number(single, ""), number(shared, ""), limit + 1e-6) << step << band << term;
      }
    }
  }
  EXPECT_LT(summary("whole")["indirect"]["packets"], summary("single")["indirect"]["packets"]);
  kill_day(together, signal_at(SIGKILL, "rename steps/step_", 6));
  EXPECT_EQ(finished_steps(), 5U);
  expect_day({"--resume"});
  expect_same_tables("whole", "out");
}

// The state of a block is kept while it is being simulated: a kill loses a few replicates, and Ctrl-C none. A clock that
// advances with each reading makes states fall due every few replicates.
TEST_F(Day, GoesOnWithinABlock) {
  const Arguments together{"--together", "4", "--error", "0.01"};
  expect_day(together, 0, "whole");
  const auto stop_at_first_state = [&](int signal, const Arguments& more) {
    preload_signals(signal_at(0, "rename steps/block_state.bin") + "," + signal_at(signal, "fsync steps"),
                    {{"SUNFLECK_FAULT_STRIDE", "0.05"}});
    may_be_killed_ = signal == SIGKILL;
    const Outcome outcome = day(more);
    EXPECT_EQ(outcome.status, signal == SIGKILL ? -1 : 130) << outcome.err;
    may_be_killed_ = false;
    preload_nothing();
    return outcome.err;
  };
  stop_at_first_state(SIGKILL, together);
  EXPECT_EQ(finished_steps(), 0U);
  const std::string told = stop_at_first_state(SIGKILL, {"--error", "0.01", "--resume"});
  EXPECT_NE(told.find("resuming steps 1 to 3 after "), std::string::npos) << told;
  stop_at_first_state(SIGINT, {"--error", "0.01", "--resume"});
  const Outcome last = day({"--error", "0.01", "--resume"});
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_NE(last.err.find("resuming steps "), std::string::npos) << last.err;
  expect_same_tables("whole", "out");
  EXPECT_FALSE(exists("steps/block_state.bin"));
}

TEST_F(Day, DoesWithoutAStateThatIsDamaged) {
  const Arguments together{"--together", "4", "--error", "0.01"};
  expect_day(together, 0, "whole");
  preload_signals(signal_at(0, "rename steps/block_state.bin") + "," + signal_at(SIGINT, "fsync steps"),
                  {{"SUNFLECK_FAULT_STRIDE", "0.05"}});
  expect_day(together, 130);
  preload_nothing();
  EXPECT_EQ(finished_steps(), 0U);
  std::string state = file("steps/block_state.bin");
  state[state.size() / 2] ^= 1;
  folder_.write("out/steps/block_state.bin", state);
  const Outcome outcome = day({"--error", "0.01", "--resume"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("resuming steps "), std::string::npos) << outcome.err;
  expect_same_tables("whole", "out");
}

// Where there is enough memory, its size changes no result.
TEST_F(Day, SimulatesSixStepsTogetherUnlessTold) {
  expect_day({"--together", "6"}, 0, "whole");
  expect_day({});
  expect_same_tables("whole", "out");
  expect_day({"--memory", "100MB"});
  expect_same_tables("whole", "out");
}

TEST_F(Day, KeepsFinishedStepsAtCtrlC) {
  expect_day(evening_, 0, "whole");
  interrupt_evening(2);
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_GE(finished_steps(), 2U);
  const Table part(file("day.csv"));
  EXPECT_EQ(part.size(), finished_steps());
  EXPECT_EQ(part.comments().back(), "# incomplete: the first " + std::to_string(part.size()) + " of 6 steps");
  EXPECT_EQ(read_fields()["sizes"]["time"], part.size());
  expect_day(evening_ + Arguments{"--resume"});
  expect_same_tables("whole", "out");
}

TEST_F(Day, ComputesDamagedStepsAgain) {
  expect_day(evening_, 0, "whole");
  interrupt_evening(3);
  const std::filesystem::path steps = folder_ / "out" / "steps";
  std::string bytes = content(steps / "step_00001.bin");
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(steps / "step_00001.bin", std::ios::binary) << bytes;
  std::filesystem::resize_file(steps / "step_00002.bin", 100);
  const Outcome outcome = day(evening_ + Arguments{"--resume"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("step 1 of"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("step 2 of"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("step 3 of"), std::string::npos) << outcome.err;
  expect_same_tables("whole", "out");
}

TEST_F(Day, ResumesWithTheSameSettingsOnly) {
  interrupt_evening(1);
  for (const auto& [names, more] : std::initializer_list<std::pair<std::string, Arguments>>{
           {"seed was 1, now 2", {"--seed", "2"}},
           {"indirect_error was 0.02, now 0.03", {"--indirect-error", "0.03"}},
           {"step_min was 60, now 30", {"--step", "30"}},
           {"to was \"20:20\", now \"20:21\"", {"--from", "15:00", "--to", "20:21"}}}) {
    const Arguments hours = more.size() == 4 ? Arguments{} : evening_;
    expect_one_error(day(hours + more + Arguments{"--resume"}), 2, names);
  }
  const std::size_t kept = finished_steps();
  folder_.write("leaves.obj", leaves + "f 1 2 4\n");
  expect_one_error(day(evening_ + Arguments{"--resume"}), 2, "has changed since that day");
  EXPECT_EQ(finished_steps(), kept);
  folder_.write("leaves.obj", leaves);
  expect_day(evening_ + Arguments{"--resume"});
  const std::string table = file("day.csv");
  const Outcome again = day(evening_ + Arguments{"--resume"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("nothing to resume"), std::string::npos) << again.err;
  EXPECT_EQ(file("day.csv"), table);
  // Without --resume the day starts from the beginning.
  expect_day({"--from", "12:00", "--to", "13:00", "--seed", "2"});
  EXPECT_EQ(Table(file("day.csv")).size(), 1U);
}

TEST_F(Day, TakesAFinishedDayForWhatItIs) {
  folder_.write("scene.toml", scene_text + "[[plane]]\nheight = 0.3\ncells = [2, 2]\n");
  const Arguments morning{"--from", "10:00", "--to", "11:00"};
  expect_day(morning);
  const Arguments again = morning + Arguments{"--resume"};
  expect_day(again);
  expect_one_error(day(again + Arguments{"--export", "nc"}), 2, "the day in out is finished, and has no plane_0.300_day.nc");
  const Outcome lacking = day(again + Arguments{"--images", "day"});
  EXPECT_EQ(lacking.status, 0);
  EXPECT_NE(lacking.err.find("the day in out is finished, and has no day.png"), std::string::npos) << lacking.err;
}

TEST_F(Day, LimitsLeaveItIncomplete) {
  expect_day(evening_, 0, "whole");
  expect_day(evening_ + Arguments{"--max-seconds", "1e-9"}, 1);
  EXPECT_EQ(Table(file("day.csv")).size(), 0U);
  EXPECT_EQ(summary()["complete"], false);
  expect_day(evening_ + Arguments{"--resume", "--max-seconds", "1e9"});
  expect_same_tables("whole", "out");
  const Arguments few_rays = Arguments{"--max-rays", "150000", "--error", "0.0005"} + evening_;
  expect_day(few_rays, 1);
  EXPECT_EQ(summary()["steps"]["short_of_bound"], 4);
  EXPECT_EQ(Table(file("day.csv")).size(), 6U);
  expect_day(few_rays + Arguments{"--resume"}, 1);
}

// So few rays that no step could begin with the work of the one before: each makes its least number of replicates.
TEST_F(Day, EveryStepHasLightHoweverFewRaysItMayHave) {
  expect_day(Arguments{"--max-rays", "1000", "--error", "0.0005"} + evening_, 1);
  const Table table(file("day.csv"));
  ASSERT_EQ(table.size(), 6U);
  for (std::size_t row = 0; row < table.size(); ++row) {
    const bool light = table.number(row, "elevation_deg") > 0.0;
    EXPECT_EQ(table.number(row, "PAR_incident") > 0.0, light) << row;
    EXPECT_EQ(table.number(row, "PAR_absorbed_vegetation") > 0.0, light) << row;
  }
}

TEST_F(Day, FixedWorkHasNoBound) {
  expect_day(Arguments{"--grid", "0.01"} + evening_);
  EXPECT_TRUE(summary()["direct"]["bound"].is_null());
  EXPECT_TRUE(summary()["indirect"]["bound"].is_null());
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Day, IsLitFromSunriseToSunsetUnlessTold) {
  const Outcome outcome = day({"--step", "120", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(json::parse(outcome.out, nullptr, false), summary());
  EXPECT_EQ(summary()["settings"]["from"], "04:00");  // sunrise is at 05:18
  EXPECT_EQ(summary()["settings"]["to"], "20:00");
  EXPECT_EQ(Table(file("day.csv")).size(), 8U);
}

TEST_F(Day, SharesNoFolderWithARun) {
  expect_day({"--from", "12:00", "--to", "13:00"});
  simulate(scene_, {"--device", "cpu", "--images", "none"});
  for (const char* name : tables) EXPECT_FALSE(exists(name)) << name;
  EXPECT_FALSE(exists("steps"));
  const Outcome refused = day({"--from", "12:00", "--to", "13:00", "--resume"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("the folder holds the result of \"run\", not of a day"), std::string::npos) << refused.err;
  EXPECT_TRUE(exists("organs.csv")) << "a day that is to be continued removes no other result";
  expect_day({"--from", "12:00", "--to", "13:00"});
  EXPECT_TRUE(exists("day.csv"));
  EXPECT_FALSE(exists("organs.csv"));
}

TEST_F(Day, DrawsItsCourse) {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  expect_day(evening_ + Arguments{"--images", "day", "--band", "NIR"});
  EXPECT_EQ(file("day.png").substr(1, 3), "PNG");
}

TEST_F(Day, RefusesWhatCannotBe) {
  for (const auto& [names, more] :
       std::initializer_list<std::pair<std::string, Arguments>>{{"--from 25:00", {"--from", "25:00"}},
                                                                {"--from 7", {"--from", "7"}},
                                                                {"--to 07:60", {"--to", "07:60"}},
                                                                {"--to 24:01", {"--to", "24:01"}},
                                                                {"--to 09:00", {"--from", "10:00", "--to", "09:00"}},
                                                                {"--to 10:00", {"--from", "10:00", "--to", "10:00"}},
                                                                {"--step 0", {"--step", "0"}},
                                                                {"--step -5", {"--step", "-5"}},
                                                                {"--step 1", {"--step", "1", "--to-date", "2003-08-08"}},
                                                                {"--date 2002-02-30", {"--date", "2002-02-30"}},
                                                                {"--date 8.8.2002", {"--date", "8.8.2002"}},
                                                                {"--date 1899-12-31", {"--date", "1899-12-31"}},
                                                                {"--to-date 2002-08-07", {"--to-date", "2002-08-07"}},
                                                                {"--band UV", {"--band", "UV"}},
                                                                {"--images", {"--images", "rank_total"}},
                                                                {"--export", {"--export", "vtp"}},
                                                                {"--export nc,none", {"--export", "none,nc"}}}) {
    const Outcome outcome = run(Arguments{"day", scene_, "-o", "out", "--device", "cpu"} + more);
    expect_one_error(outcome, 2, names);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << names;
  }
}

TEST_F(Day, NeedsWeatherForAllItsSteps) {
  std::string text = scene_text;
  const std::string clear = "[weather]\nclear_sky = \"ineichen\"\n";
  text.replace(text.find(clear), clear.size(), "[weather]\nfile = \"station.csv\"\n");
  scene_ = folder_.write("scene.toml", text).string();
  folder_.write("station.csv",
                "time,ghi\n2002-08-08T10:00+08:00,700\n2002-08-08T11:00+08:00,800\n2002-08-08T12:00+08:00,750\n");
  expect_day({"--from", "10:00", "--to", "13:00", "--step", "30"});
  const Table day_table(file("day.csv"));
  EXPECT_NEAR(day_table.number(2, "PAR_incident"), 400.0, 1e-6);
  EXPECT_NEAR(day_table.number(4, "PAR_incident"), 375.0, 1e-6);
  expect_one_error(day({"--from", "10:00", "--to", "14:00"}, "other"), 2, "2002-08-08");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "other"));
  text.replace(text.find("[weather]\nfile = \"station.csv\"\n"), 31, "");
  while (text.find("share = 0.5\n") != std::string::npos) text.replace(text.find("share = 0.5\n"), 12, "");
  folder_.write("scene.toml", text);
  expect_one_error(day({}, "other"), 2, "band");
}

}  // namespace
}  // namespace sunfleck::regression

// Tests fixed work, limits, interruption, and what is printed where.

#include "regression/preload.h"
#include "regression/small_scene.h"
#include "support/table.h"

namespace sunfleck::regression {
namespace {

using nlohmann::json;

const Arguments on_cpu{"--device", "cpu", "--images", "none"};

class Limits : public PreloadTest {
 protected:
  // Expects complete files of an incomplete run, in which every number is finite or missing.
  void expect_kept() const {
    EXPECT_EQ(summary().value("complete", true), false);
    for (const char* name : {"profile.csv", "organs.csv"}) {
      const Table table(file(name));
      EXPECT_GT(table.size(), 0U);
      for (std::size_t row = 0; row < table.size(); ++row)
        for (const std::string& column : table.columns())
          if (column != "organ" && column != "role") static_cast<void>(table.number(row, column));
    }
  }
  const std::filesystem::path maize_ = scene_file("maize_sparse.toml");
  const std::filesystem::path squares_ = scene_file("two_squares.toml");
};

TEST_F(Limits, GridFixesTheWork) {
  simulate(maize_, on_cpu + Arguments{"--grid", "0.006"});
  const json direct = summary()["direct"];
  EXPECT_NEAR(direct["grid_m"], 0.006, 0.01 * 0.006);
  EXPECT_EQ(direct["replicates"], 16);
  EXPECT_TRUE(direct["bound"].is_null());
  EXPECT_TRUE(summary()["indirect"]["bound"].is_null());
  EXPECT_GT(direct["relative_error"], 0.0);
}

TEST_F(Limits, PassesFixTheReplicates) {
  simulate(squares_, on_cpu + Arguments{"--passes", "11", "--direct-error", "0.05"});
  EXPECT_EQ(summary()["direct"]["replicates"], 11);
  EXPECT_TRUE(summary()["direct"]["bound"].is_null());
  EXPECT_TRUE(summary()["indirect"]["bound"].is_null());
  simulate(maize_, on_cpu + Arguments{"--passes", "8", "--grid", "0.006"});
  EXPECT_EQ(summary()["direct"]["replicates"], 8);
  EXPECT_NEAR(summary()["direct"]["grid_m"], 0.006, 0.01 * 0.006);
}

TEST_F(Limits, ErrorSetsBothBounds) {
  simulate(squares_, on_cpu + Arguments{"--error", "0.04"});
  EXPECT_EQ(summary()["settings"]["direct_error"], 0.04);
  EXPECT_EQ(summary()["settings"]["indirect_error"], 0.04);
  EXPECT_EQ(summary()["direct"]["bound"], 0.04);
  EXPECT_LE(summary()["direct"]["relative_error"], 0.04);
  simulate(squares_, on_cpu + Arguments{"--error", "0.04", "--direct-error", "0.05"});
  EXPECT_EQ(summary()["settings"]["direct_error"], 0.05);
  EXPECT_EQ(summary()["settings"]["indirect_error"], 0.04);
}

// The bound of the indirect pass also holds for the line of sensors; the limit that ends the search for it is named.
TEST_F(Limits, ABoundHoldsForSensors) {
  folder_.write("leaves.obj", leaves_obj);
  const std::string line =
      two_band_scene + "[[sensor]]\nname = \"line\"\nfrom = [0.2, 0.2, 0.5]\nto = [0.8, 0.2, 0.5]\npoints = 4\n";
  const auto scene = folder_.write("scene.toml", line + "[accuracy]\nof = \"sensors\"\n");
  const Outcome outcome = simulate(scene, on_cpu + Arguments{"--error", "0.01"});
  json sensors = summary()["sensors"];
  EXPECT_GT(sensors["replicates"], 8);
  EXPECT_LE(sensors["relative_error"], 0.01);
  EXPECT_EQ(sensors["bound"], 0.01);
  EXPECT_NE(outcome.out.find("sensors: " + sensors["replicates"].dump() + " replicates"), std::string::npos) << outcome.out;
  const Table means(file("sensor_means.csv"));
  ASSERT_EQ(means.size(), 2U);
  for (std::size_t row = 0; row < 2; ++row)
    for (const char* band : {"PAR", "NIR"})
      EXPECT_LE(means.number(row, std::string(band) + "_total_error"), 0.01 * means.number(row, std::string(band) + "_total"));

  // On a clock of which 100 readings make a second.
  preload({{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const std::string beyond =
      simulate(scene, on_cpu + Arguments{"--direct-error", "0.01", "--indirect-error", "2e-4", "--max-seconds", "20"}, 1).err;
  EXPECT_NE(beyond.find("stopped after --max-seconds 20"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("sensors error"), std::string::npos) << beyond;
  EXPECT_EQ(summary()["complete"], false);

  preload_nothing();
  folder_.write("scene.toml", line);
  simulate(scene, on_cpu + Arguments{"--error", "0.01"});
  sensors = summary()["sensors"];
  EXPECT_EQ(sensors["replicates"], 8);
  EXPECT_TRUE(sensors["bound"].is_null());
}

TEST_F(Limits, RaysStopTheRun) {
  const Outcome outcome = simulate(maize_, on_cpu + Arguments{"--direct-error", "1e-7", "--max-rays", "3e5", "--quiet"}, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("--max-rays 300000"), std::string::npos) << outcome.err;
  EXPECT_LE(summary()["direct"]["rays"], 300000);
  EXPECT_GT(summary()["direct"]["rays"], 100000);
  EXPECT_EQ(summary()["direct"]["bound"], 1e-7);
  EXPECT_GT(summary()["direct"]["relative_error"], 1e-7);
  expect_kept();
}

// On a clock of which 100 readings make a second, the time always runs out after the same work.
TEST_F(Limits, SecondsStopTheRun) {
  preload({{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const Outcome outcome = simulate(maize_, on_cpu + Arguments{"--direct-error", "1e-7", "--max-seconds", "6"}, 1);
  const double spent_s = summary()["direct"]["seconds"].get<double>() + summary()["indirect"]["seconds"].get<double>();
  EXPECT_GE(spent_s, 6.0);
  EXPECT_LT(spent_s, 7.0);
  EXPECT_GE(summary()["direct"]["replicates"], 2);
  EXPECT_NE(outcome.err.find("--max-seconds 6"), std::string::npos) << outcome.err;
  expect_kept();
}

TEST_F(Limits, NoTimeAtAllIsSaid) {
  const Outcome outcome = simulate(squares_, on_cpu + Arguments{"--max-seconds", "1e-9"}, 1);
  EXPECT_NE(outcome.err.find("no light yet"), std::string::npos) << outcome.err;
  EXPECT_EQ(summary()["direct"]["rays"], 0);
  expect_kept();
}

// The signals come before the first ray, during the pilots, and during the replicates of the run, which would not end on its
// own.
TEST_F(Limits, SignalsEndTheRunCleanly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const int reading : {1, 100, 1000}) {
      SCOPED_TRACE(reading);
      preload_signals("0@rename summary.json," + signal_at(signal, "clock", reading), {{"SUNFLECK_FAULT_STRIDE", "0.01"}});
      const Outcome outcome = simulate(maize_, {"--device", "cpu", "--direct-error", "0.05", "--passes", "60000"}, 130);
      EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
      EXPECT_EQ(summary()["direct"]["replicates"] > 0, reading > 1) << summary()["direct"];
      expect_kept();
      EXPECT_FALSE(exists("rank_direct.png"));
    }
  }
}

TEST_F(Limits, ASignalWhilePicturesAreDrawnKeepsTheTables) {
  preload_signals(signal_at(SIGINT, "rename organs.csv"));
  simulate(maize_, {"--device", "cpu", "--grid", "0.01"}, 130);
  EXPECT_FALSE(exists("rank_direct.png"));
  EXPECT_EQ(summary()["stopped"], "interrupted");
  EXPECT_EQ(summary()["direct"]["replicates"], 16);
  expect_kept();
}

TEST_F(Limits, AFolderHoldsOneRun) {
  simulate(squares_, {"--device", "cpu", "--grid", "0.05", "--export", "csv", "--size", "160x120"});
  EXPECT_TRUE(exists("triangles.csv"));
  EXPECT_TRUE(exists("rank_direct.png"));
  folder_.write("out/notes.txt", "mine");
  folder_.write("out/plane_tree.png", "mine");
  const Outcome refused = run({"run", squares_.string(), "-o", "out", "--device", "nonexistent"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_EQ(summary()["complete"], true) << "a run that never began spoils nothing";
  simulate(squares_, on_cpu + Arguments{"--grid", "0.05", "--seed", "2"});
  EXPECT_FALSE(exists("triangles.csv"));
  EXPECT_FALSE(exists("rank_direct.png"));
  EXPECT_TRUE(exists("notes.txt"));
  EXPECT_TRUE(exists("plane_tree.png")) << "no name of a run's own: a height would follow plane_";
  EXPECT_EQ(summary()["seed"], 2);
}

TEST_F(Limits, ForeignFilesStay) {
  std::filesystem::create_directories(folder_ / "mine");
  folder_.write("mine/triangles.csv", "mine");
  simulate(squares_, on_cpu + Arguments{"--grid", "0.05"}, 0, "mine");
  EXPECT_EQ(file("triangles.csv", "mine"), "mine");
}

TEST_F(Limits, WhatIsSaidWhere) {
  const Arguments quick = on_cpu + Arguments{"--grid", "0.05"};
  const Outcome plain = simulate(squares_, quick);
  EXPECT_EQ(plain.err, "device: CPU path\n");
  EXPECT_NE(plain.out.find("Two black squares"), std::string::npos);
  const Outcome quiet = simulate(squares_, quick + Arguments{"--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  const Outcome summary_only = simulate(squares_, quick + Arguments{"--json"});
  EXPECT_EQ(summary_only.err, "");
  EXPECT_EQ(summary_only.out, file("summary.json"));
  EXPECT_EQ(json::parse(summary_only.out)["complete"], true);
}

TEST_F(Limits, ImagesAndExportsAreChosen) {
  const Arguments quick{"--device", "cpu", "--grid", "0.05", "--size", "160x120"};
  EXPECT_EQ(run(Arguments{"run", "--images", "none", squares_.string()} + quick).status, 0);
  EXPECT_TRUE(exists("summary.json", "results/two_squares"));  // the folder without -o
  EXPECT_FALSE(exists("rank_direct.png", "results/two_squares"));
  EXPECT_FALSE(exists("triangles.csv", "results/two_squares"));
  EXPECT_EQ(run(Arguments{"run", "--images", "rank_direct", "--export", "csv", squares_.string()} + quick).status, 0);
  EXPECT_TRUE(exists("rank_direct.png", "results/two_squares"));
  EXPECT_TRUE(exists("triangles.csv", "results/two_squares"));
}

TEST_F(Limits, ASunBelowTheHorizonIsNoError) {
  std::string night = content(squares_);
  night.replace(night.find("elevation = 45.0"), 16, "elevation = -5.0");
  folder_.write("night.toml", night);
  std::filesystem::copy_file(scene_file("two_squares.obj"), folder_ / "two_squares.obj");
  const Outcome outcome = simulate("night.toml", {"--device", "cpu"});
  const std::size_t warning = outcome.err.find("warning: ");
  EXPECT_NE(warning, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning: ", warning + 1), std::string::npos) << outcome.err;
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_EQ(summary()["bands"][0]["incident"], 0.0);
  EXPECT_TRUE(summary()["ground_sunfleck_ratio"].is_null());
  const Table profile(file("profile.csv"));
  for (std::size_t row = 0; row < profile.size(); ++row) {
    EXPECT_EQ(profile.cell(row, "sunfleck_ratio"), "");
    EXPECT_EQ(profile.number(row, "PAR_down"), 0.0);
  }
  const Table organs(file("organs.csv"));
  for (std::size_t row = 0; row < organs.size(); ++row) EXPECT_EQ(organs.number(row, "PAR_absorbed"), 0.0);
}

}  // namespace
}  // namespace sunfleck::regression

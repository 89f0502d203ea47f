// Tests `sunfleck tradeoff`: its table, its messages, its slopes, and how it ends.

#include "regression/preload.h"
#include "support/table.h"

#include <cmath>
#include <fstream>
#include <map>
#include <set>

namespace sunfleck::regression {
namespace {

using nlohmann::json;

// A tilted leaf over soil, so that the edges of its shadow cross the cells of every grid.
const std::string leaf_scene = R"(title = "One leaf"
[plot]
size = [1.0, 1.0]
[sun]
elevation = 50.0
azimuth = 130.0
[[band]]
name = "PAR"
direct = 350.0
[soil]
reflectance = 0.2
[optics.leaf]
reflectance = 0.3
transmittance = 0.2
[[geometry]]
file = "leaf.obj"
optics = "leaf"
[output]
layers = 4
)";
const std::string leaf_mesh = R"(v 0.20 0.50 0.13
v 0.35 0.62 0.71
v 0.83 0.47 0.55
v 0.61 0.41 0.09
f 1 2 3
f 1 3 4
)";

class Tradeoff : public PreloadTest {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "leaf.toml") << leaf_scene;
    std::ofstream(folder_ / "leaf.obj") << leaf_mesh;
  }
  Outcome tradeoff(const Arguments& more, int status = 0) const {
    Outcome outcome = run(Arguments{"tradeoff", "leaf.toml", "-o", "out", "--device", "cpu"} + more);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return outcome;
  }
};

TEST_F(Tradeoff, TableAndSlopes) {
  constexpr std::size_t seeds = 8;
  const Outcome outcome = tradeoff(
      {"--rays", "250000", "--seeds", std::to_string(seeds), "--for", "0.02", "--of", "canopy", "--grid", "0.01", "--json"});
  const json report = json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << outcome.out;
  EXPECT_TRUE(report["complete"]);

  const std::string text = file("tradeoff.csv");
  const Table table(text);
  EXPECT_NE(text.find("\nsetting,seed,seconds,rays,quantity,true_relative_error,reported_relative_error,covered"),
            std::string::npos);
  EXPECT_NE(text.find("# One leaf\n"), std::string::npos);
  std::map<std::string, std::set<double>> seeds_of;
  for (std::size_t row = 0; row < table.size(); ++row) {
    seeds_of[table.cell(row, "setting")].insert(table.number(row, "seed"));
    EXPECT_GE(table.number(row, "true_relative_error"), 0.0);
    EXPECT_GT(table.number(row, "seconds"), 0.0);
    EXPECT_GT(table.number(row, "rays"), 0.0);
    const double covered = table.number(row, "covered");
    EXPECT_TRUE(std::isnan(covered) || (covered >= 0.0 && covered <= 1.0));
    EXPECT_EQ(std::isnan(covered), std::isnan(table.number(row, "reported_relative_error")));
  }
  const std::map<std::string, std::size_t> expected{{"grid 0.002", 1},   {"grid 0.004", 2},  {"grid 0.01", 4},
                                                    {"packets 4096", 1}, {"packets 256", 4}, {"error 0.02", 1},
                                                    {"error 0.005", 1}};
  for (const auto& [setting, factor] : expected) EXPECT_EQ(seeds_of[setting].size(), factor * seeds) << setting;

  // Validation G3 has -0.73 for sharp edges on a jittered grid, and its limit is -0.68. The relative spread of a level's root
  // mean square over n seeds is 1 / sqrt(2 n): 0.25 at the finest level, then 0.18, then 0.125. For six levels a factor of four
  // apart the slope is the sum of the logarithms with weights (k - 2.5) / (17.5 log 4): its standard error is 0.032.
  const json& slopes = report["slopes"];
  int seen = 0;
  for (const json& slope : slopes) {
    if (slope["quantity"] != "canopy") continue;
    ++seen;
    const double gate = slope["light"] == "direct" ? -0.68 : -0.47;
    EXPECT_LT(slope["rays"]["slope"], gate + 2.0 * 0.032) << slope;
    if (slope["light"] == "direct") {
      EXPECT_GT(slope["rays"]["slope"], -0.75 - 3.0 * 0.032) << slope;
    }
  }
  EXPECT_EQ(seen, 2);
  EXPECT_EQ(report["recommendation"]["quantity"], "canopy");
  EXPECT_EQ(report["recommendation"]["asked_relative_error"], 0.02);
  EXPECT_GT(report["recommendation"]["error"], 0.0);
}

TEST_F(Tradeoff, SaysWhatItRecommendsAndRepeatsItself) {
  const Arguments few{"--rays", "200000", "--seeds", "4", "--for", "0.1"};
  const Outcome outcome = tradeoff(few);
  EXPECT_NE(outcome.out.find("  for 10 % per organ: --error 0."), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("on this device"), std::string::npos);
  EXPECT_NE(outcome.out.find("rays to the power of"), std::string::npos);
  const Table first(file("tradeoff.csv"));
  tradeoff(few + Arguments{"--quiet", "--threads", "1"});
  const Table second(file("tradeoff.csv"));
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t row = 0; row < first.size(); ++row) {
    for (const char* column :
         {"setting", "seed", "rays", "quantity", "true_relative_error", "reported_relative_error", "covered"})
      EXPECT_EQ(first.cell(row, column), second.cell(row, column)) << column << " of row " << row;
  }
}

TEST_F(Tradeoff, CoarserMeshesAreJudgedByAllButTriangles) {
  tradeoff({"--rays", "2000", "--seeds", "4", "--meshes", "0.5"});
  const Table table(file("tradeoff.csv"));
  std::set<std::string> judged;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table.cell(row, "setting") == "mesh 0.5") judged.insert(table.cell(row, "quantity"));
  }
  EXPECT_EQ(judged, (std::set<std::string>{"canopy", "layer", "organ"}));
}

TEST_F(Tradeoff, StopsInTimeAndKeepsWhatIsDone) {
  const Outcome none = tradeoff({"--seeds", "100", "--max-seconds", "1e-9"}, 1);
  EXPECT_NE(none.err.find("stopped after --max-seconds 1e-09 after 0 settings"), std::string::npos) << none.err;
  EXPECT_NE(file("tradeoff.csv").find("# incomplete"), std::string::npos);
  EXPECT_NE(file("tradeoff.csv").find("\nsetting,seed,"), std::string::npos);
  EXPECT_EQ(Table(file("tradeoff.csv")).size(), 0U);
  // On a clock of which 100 readings make a second, the limit falls after the reference and before the last setting.
  preload({{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const Outcome some = tradeoff({"--rays", "2000", "--seeds", "100", "--max-seconds", "60"}, 1);
  EXPECT_NE(some.err.find("stopped after --max-seconds 60 after "), std::string::npos) << some.err;
  EXPECT_NE(file("tradeoff.csv").find("# incomplete"), std::string::npos);
  EXPECT_GT(Table(file("tradeoff.csv")).size(), 0U);
}

TEST_F(Tradeoff, StopsAtCtrlC) {
  preload_signals(signal_at(SIGINT, "clock", 100));
  const Outcome outcome = tradeoff({"--seeds", "100"}, 130);
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  EXPECT_NE(file("tradeoff.csv").find("# incomplete"), std::string::npos);
}

TEST_F(Tradeoff, RefusesBadUsageInOneLine) {
  for (const Arguments& bad : {Arguments{"--for", "0"},
                               {"--for", "2"},
                               {"--of", "plant"},
                               {"--seeds", "1"},
                               {"--meshes", "1.5"},
                               {"--meshes", "x"},
                               {"--rays", "1"},
                               {"--grid", "-1"},
                               {"--grid", "1e-9"}}) {
    const Outcome outcome = run(Arguments{"tradeoff", "leaf.toml", "-o", "bad", "--device", "cpu"} + bad);
    expect_one_error(outcome, 2, bad[0]);
  }
}

TEST_F(Tradeoff, NeedsLight) {
  std::string dark = leaf_scene;
  dark.replace(dark.find("50.0"), 4, "-5.0");
  dark += "[optics.unused_lamp]\nreflectance = 0.1\ntransmittance = 0.0\nemission = 100.0\n";
  std::ofstream(folder_ / "dark.toml") << dark;
  const Outcome outcome = run({"tradeoff", "dark.toml", "-o", "bad", "--device", "cpu"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("sunfleck: dark.toml (the scene has no light"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("tradeoff.csv", "bad"));
}

}  // namespace
}  // namespace sunfleck::regression

// Tests that the same scene and seed give the same bytes on every device and with any number of threads.

#include "regression/program.h"

namespace sunfleck::regression {
namespace {

const std::vector<std::string> result_tables{"profile.csv", "organs.csv", "triangles.csv"};

class Identity : public ProgramTest {
 protected:
  void compute(const std::string& to, const Arguments& more) const {
    simulate(scene_file("maize_sparse.toml"),
             Arguments{"--grid", "0.01", "--export", "csv", "--images", "rank_direct", "--size", "160x120"} + more, 0, to);
    for (const std::string& table : result_tables) EXPECT_GT(file(table, to).size(), 1000U) << table;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const std::string& table : result_tables) EXPECT_TRUE(file(table, one) == file(table, other)) << table;
    EXPECT_TRUE(file("rank_direct.png", one) == file("rank_direct.png", other));
  }
};

class IdentityOfDevices : public Identity {
 protected:
  void SetUp() override {
    if (!nlohmann::json::parse(run({"info", "--json"}).out).at("devices").empty()) return;
    ASSERT_FALSE(is_set("SUNFLECK_REQUIRE_DEVICE")) << "no Vulkan device, and SUNFLECK_REQUIRE_DEVICE=1 asks for one";
    GTEST_SKIP() << "no Vulkan device on this machine";
  }
};

TEST_F(Identity, TwoRunsOneThreadAndAnotherSeed) {
  compute("a", {"--device", "cpu", "--threads", "2"});
  compute("b", {"--device", "cpu", "--threads", "2"});
  expect_same("a", "b");
  compute("one_thread", {"--device", "cpu", "--threads", "1"});
  expect_same("a", "one_thread");
  compute("other", {"--device", "cpu", "--threads", "2", "--seed", "2"});
  for (const std::string& table : result_tables) EXPECT_TRUE(file(table, "a") != file(table, "other")) << table;
}

TEST_F(IdentityOfDevices, CpuAndSoftwareVulkan) {
  compute("a", {"--device", "cpu"});
  compute("b", {"--device", "lavapipe"});
  EXPECT_EQ(summary("b")["device"]["kind"], "vulkan");
  expect_same("a", "b");
}

// Of a scene with lamps, and of one with panels in the beam.
TEST_F(IdentityOfDevices, CpuAndSoftwareVulkanWithStructures) {
  for (const char* scene : {"chamber.toml", "panels.toml"}) {
    for (const char* device : {"cpu", "lavapipe"}) {
      simulate(scene_file(scene),
               {"--device", device, "--grid", "0.02", "--passes", "8", "--export", "csv", "--images", "none"}, 0, device);
      EXPECT_EQ(summary(device)["bands"][0]["residual"], 0) << scene;
      EXPECT_GT(summary(device)["bands"][0]["absorbed_structure"], 1.0) << scene;
    }
    for (const std::string& table : result_tables) EXPECT_TRUE(file(table, "cpu") == file(table, "lavapipe")) << scene << table;
    EXPECT_EQ(summary("cpu")["bands"], summary("lavapipe")["bands"]);
  }
}

// Packets of a block carry the light of all of its steps.
TEST_F(IdentityOfDevices, CpuAndSoftwareVulkanWithStepsTogether) {
  for (const char* device : {"cpu", "lavapipe"}) {
    const Outcome day = run({"day",        scene_file("maize_day.toml"),
                             "--from",     "08:00",
                             "--to",       "10:00",
                             "--step",     "60",
                             "--together", "2",
                             "--grid",     "0.05",
                             "--passes",   "8",
                             "--images",   "none",
                             "--device",   device,
                             "-o",         device});
    ASSERT_EQ(day.status, 0) << day.err;
  }
  for (const char* table : {"day.csv", "organs_day.csv"}) {
    EXPECT_GT(file(table, "cpu").size(), 500U) << table;
    EXPECT_EQ(file(table, "cpu"), file(table, "lavapipe")) << table;
  }
}

TEST_F(Identity, EndsAtTheBoundAlike) {
  const Arguments more{"--direct-error", "0.02", "--images", "none"};
  simulate(scene_file("two_squares.toml"), Arguments{"--device", "cpu"} + more, 0, "a");
  simulate(scene_file("two_squares.toml"), Arguments{"--device", "cpu", "--threads", "1"} + more, 0, "b");
  EXPECT_EQ(file("profile.csv", "a"), file("profile.csv", "b"));
  EXPECT_EQ(file("organs.csv", "a"), file("organs.csv", "b"));
}

}  // namespace
}  // namespace sunfleck::regression

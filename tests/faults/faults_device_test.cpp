// Tests Vulkan calls that fail: no memory on the device, and a device that is lost, at any call of its kind.

#include "faults/faults.h"

#include <sstream>

namespace sunfleck::faults {
namespace {

constexpr int out_of_host_memory = -1, out_of_device_memory = -2, initialisation_failed = -3, device_lost = -4;

class Device : public FaultTest {
 protected:
  void SetUp() override {
    const Outcome info = run({"info", "--json"});
    const nlohmann::json devices = nlohmann::json::parse(info.out)["devices"];
    const bool software =
        std::any_of(devices.begin(), devices.end(), [](const auto& d) { return d["kind"] == "software Vulkan"; });
    if (software) return;
    if (regression::is_set("SUNFLECK_REQUIRE_DEVICE"))
      FAIL() << "no software Vulkan device, and SUNFLECK_REQUIRE_DEVICE=1 asks for one";
    GTEST_SKIP() << "no software Vulkan device on this machine";
  }

  // Lets the `from`th and all later calls of this function fail.
  void let_fail(const std::string& call, unsigned from, int result) {
    const std::string fault = call + " " + std::to_string(from) + " " + std::to_string(result);
    const std::string log = (folder_ / "calls.txt").string();
    before_program_ = [fault, log] {
      ::setenv("VK_LAYER_PATH", SUNFLECK_FAULT_LAYERS, 1);
      ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_SUNFLECK_faults", 1);
      ::setenv("SUNFLECK_FAULT_CALL", fault.c_str(), 1);
      ::setenv("SUNFLECK_FAULT_LOG", log.c_str(), 1);
    };
  }

  // Returns how often an undisturbed run calls each function.
  [[nodiscard]] std::map<std::string, unsigned> calls(const Arguments& arguments) {
    let_fail("none", 1, 0);
    EXPECT_EQ(run(arguments).status, 0);
    std::map<std::string, unsigned> counts = last_calls();
    EXPECT_EQ(counts["vkCreateDevice"], 1U) << "the layer is not in use";
    return counts;
  }

  // Returns how often the last run called each function.
  [[nodiscard]] std::map<std::string, unsigned> last_calls() const {
    std::istringstream log(content(folder_ / "calls.txt"));
    std::map<std::string, unsigned> counts;
    std::string name;
    unsigned count = 0;
    while (log >> name >> count) counts[name] = count;
    return counts;
  }

  // Returns the first few numbers, then fewer and fewer, and the last.
  static std::vector<unsigned> some_of(unsigned count) {
    std::vector<unsigned> numbers;
    for (unsigned n = 1; n < count; n = n < 3 ? n + 1 : n * 2) numbers.push_back(n);
    if (count > 0) numbers.push_back(count);
    return numbers;
  }

  // Draws neither pictures nor plots.
  const Arguments traced_{"run",    "scene.toml", "-o",       "out", "--device", "lavapipe",
                          "--grid", "0.1",        "--passes", "8",   "--images", "none"};

  void expect_refused(const Arguments& arguments, const std::string& call, unsigned from, int result,
                      const std::map<std::string, std::string>& whole, const std::string& why) {
    SCOPED_TRACE(call + " " + std::to_string(from) + " " + std::to_string(result));
    let_fail(call, from, result);
    const Outcome outcome = run(arguments);
    // Work is cut into pieces by the time that they take, so that another run may end before its last calls have this number.
    if (outcome.status != 0 || last_calls()[call] >= from) {
      expect_one_line(outcome, why);
      EXPECT_NE(outcome.err.find("llvmpipe"), std::string::npos) << outcome.err;
      expect_whole(whole);
    }
    std::filesystem::remove_all(folder_ / "out");
  }
};

TEST_F(Device, WithoutMemory) {
  const auto counts = calls(traced_);
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "out");
  for (const char* call : {"vkAllocateMemory", "vkCreateBuffer"}) {
    ASSERT_GT(counts.at(call), 5U);
    for (unsigned from = 1; from <= counts.at(call); from += call == std::string("vkAllocateMemory") ? 1 : 7) {
      expect_refused(traced_, call, from, out_of_device_memory, whole, "out of memory");
    }
  }
  for (const char* call : {"vkMapMemory", "vkBindBufferMemory", "vkCreateBufferView", "vkAllocateDescriptorSets",
                           "vkCreateComputePipelines", "vkCreateDescriptorPool", "vkCreateShaderModule", "vkCreateFence",
                           "vkCreateCommandPool", "vkAllocateCommandBuffers", "vkCreateDescriptorSetLayout",
                           "vkCreatePipelineLayout", "vkCreateDevice", "vkBeginCommandBuffer", "vkEndCommandBuffer"}) {
    expect_refused(traced_, call, counts.at(call), out_of_host_memory, whole, "out of memory");
  }
}

TEST_F(Device, ThatIsLost) {
  const auto counts = calls(traced_);
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "out");
  for (const char* call : {"vkQueueSubmit", "vkWaitForFences"}) {
    ASSERT_GT(counts.at(call), 50U);
    for (const unsigned from : some_of(counts.at(call))) {
      expect_refused(traced_, call, from, device_lost, whole, "the device was lost");
    }
  }
  expect_refused(traced_, "vkResetFences", 5, device_lost, whole, "the device was lost");
}

TEST_F(Device, ThatIsLostWhilePicturesAreDrawnLeavesTheTables) {
  const Arguments drawn = Arguments{"run", "scene.toml", "-o", "out",    "--device", "lavapipe", "--grid",
                                    "0.1", "--passes",   "8",  "--size", "64x64",    "--images", "rank_direct,hue_total"};
  const auto counts = calls(drawn);
  const auto whole = files();
  let_fail("vkQueueSubmit", counts.at("vkQueueSubmit"), device_lost);
  expect_one_line(run(drawn), "the device was lost");
  expect_whole(whole);
  EXPECT_TRUE(exists("organs.csv") && exists("result.bin") == whole.contains("result.bin"));
  EXPECT_FALSE(exists("rank_direct.png"));
  EXPECT_EQ(summary()["not_written"].size(), 1U);
  EXPECT_EQ(summary()["bands"].size(), 1U);
}

TEST_F(Device, ThatIsLostLeavesADayToBeResumedElsewhere) {
  const auto on = [](const char* device) {
    return Arguments{"day",        "day.toml", "-o",       "out",  "--from", "10:00", "--to",     "13:00",
                     "--together", "1",        "--images", "none", "--grid", "0.1",   "--device", device};
  };
  const auto counts = calls(on("lavapipe"));
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "out");
  let_fail("vkQueueSubmit", counts.at("vkQueueSubmit") / 2, device_lost);
  const Outcome outcome = run(on("lavapipe"));
  expect_one_line(outcome, "the device was lost");
  EXPECT_NE(outcome.err.find("--resume"), std::string::npos) << outcome.err;
  EXPECT_TRUE(exists("steps/step_00000.bin"));
  before_program_ = {};
  EXPECT_EQ(run(on("cpu") + Arguments{"--resume"}).status, 0);
  for (const char* name : {"day.csv", "day_sums.csv", "organs_day.csv", "plants_day.csv"})
    EXPECT_TRUE(file(name) == whole.at(name)) << name;
}

TEST_F(Device, ThatFailsIsNotReplacedInSilence) {
  let_fail("vkQueueSubmit", 9, device_lost);
  expect_one_line(run(traced_), "the device was lost");
  let_fail("vkAllocateMemory", 2, out_of_device_memory);
  expect_one_line(run(traced_), "--device cpu");
  let_fail("vkCreateDevice", 1, initialisation_failed);
  expect_one_line(run(traced_), "CPU path");
}

TEST_F(Device, ThatIsLostLeavesNoPicture) {
  const Arguments drawn{"render", "scene.toml", "-o",       "out.png", "--device", "lavapipe",
                        "--grid", "0.1",        "--passes", "8",       "--size",   "64x64"};
  const unsigned submissions = calls(drawn).at("vkQueueSubmit");
  std::filesystem::remove(folder_ / "out.png");
  for (const unsigned from : {1U, submissions / 2, submissions}) {
    let_fail("vkQueueSubmit", from, device_lost);
    expect_one_line(run(drawn), "the device was lost");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png"));
  }
}

}  // namespace
}  // namespace sunfleck::faults

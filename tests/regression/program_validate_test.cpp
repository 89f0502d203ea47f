// Tests sunfleck validate: quick cases, on the CPU path and on software Vulkan, and requests that are refused.

#include "regression/program.h"

#include <sstream>

namespace sunfleck::regression {
namespace {

class Validate : public ProgramTest {
 protected:
  [[nodiscard]] nlohmann::json table(const std::string& of = "out") const {
    return nlohmann::json::parse(file("validate.json", of), nullptr, false);
  }
};

// Returns the rows of the Markdown table, as text.
std::vector<std::string> markdown_rows(const std::string& text) {
  std::vector<std::string> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) == 0) rows.push_back(line);
  }
  rows.erase(rows.begin(), rows.begin() + 2);  // removes the names of the columns and the rule below them
  return rows;
}

const Arguments quick_cases{"validate", "--cases", "sun", "--cases", "view", "--cases", "plates", "--cases", "strips"};

TEST_F(Validate, OnTheCpuPath) {
  const Outcome outcome = run(quick_cases + Arguments{"--device", "cpu", "-o", "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const nlohmann::json report = table();
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["failed"], 0);
  EXPECT_EQ(report["device"]["kind"], "cpu");
  const std::vector<std::string> rows = markdown_rows(file("validate.md"));
  ASSERT_EQ(rows.size(), report["cases"].size());
  EXPECT_GT(rows.size(), 50U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const nlohmann::json& each = report["cases"][k];
    EXPECT_EQ(each["verdict"], "pass");
    EXPECT_EQ(each["z"].is_null(), each["standard_error"] == 0.0) << each;
    EXPECT_EQ(rows[k].rfind("| " + each["case"].get<std::string>() + " |", 0), 0U) << rows[k];
    EXPECT_NE(outcome.out.find(each["case"].get<std::string>()), std::string::npos);
  }
}

// Software Vulkan gives the same numbers to the last bit.
TEST_F(Validate, OnSoftwareVulkanAsOnTheCpuPath) {
  const Arguments some{"validate", "--cases", "view", "--cases", "over soil", "--json"};
  const Outcome device = run(some + Arguments{"--device", "lavapipe", "-o", "device"});
  if (device.status == 3 && !is_set("SUNFLECK_REQUIRE_DEVICE")) GTEST_SKIP() << device.err;
  EXPECT_EQ(device.status, 0) << device.err;
  EXPECT_EQ(device.err, "");
  EXPECT_EQ(device.out, file("validate.json", "device"));
  EXPECT_EQ(run(some + Arguments{"--device", "cpu", "-o", "cpu"}).status, 0);
  EXPECT_TRUE(table("device")["cases"] == table("cpu")["cases"]);
}

TEST_F(Validate, QuietSaysFailuresOnly) {
  const Outcome outcome = run({"validate", "--quiet", "--cases", "weather", "--device", "cpu"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(exists("validate.json", "results/validate"));
  EXPECT_TRUE(exists("validate.md", "results/validate"));
}

TEST_F(Validate, RefusesWhatItCannotDo) {
  expect_one_error(run({"validate", "--cases", "nonsense", "--device", "cpu"}), 2, "nonsense");
  expect_one_error(run({"validate", "--device", "nonexistent"}), 3, "\"nonexistent\"");
  folder_.write("file", "not a folder");
  expect_one_error(run({"validate", "--device", "cpu", "-o", "file"}), 1, "file");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
}

TEST_F(Validate, StopsAtCtrlC) {
  bool sent = false;
  const auto interrupt = [&](pid_t child, const std::string& err) {
    if (!sent && err.find("device:") != std::string::npos) sent = ::kill(child, SIGINT) == 0;
  };
  const Outcome outcome = run({"validate", "--device", "cpu", "--cases", "Beer", "-o", "out"}, interrupt);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(table()["complete"], false);
}

}  // namespace
}  // namespace sunfleck::regression

// Signals at any time, and clocks that jump.

#include "faults/faults.h"

#include <random>

namespace sunfleck::faults {
namespace {

using std::chrono::microseconds;
using std::chrono::steady_clock;

class Signals : public FaultTest {
 protected:
  // Sends the signals one after the other, the first after `wait`, the others after as long again.
  static Watch send_after(microseconds wait, std::vector<int> signals) {
    return [wait, signals = std::move(signals), sent = std::size_t{0}, begin = steady_clock::now()](
               pid_t child, const std::string&) mutable {
      if (sent < signals.size() && steady_clock::now() - begin >= wait * static_cast<int>(sent + 1)) {
        ::kill(child, signals[sent++]);
      }
    };
  }

  // Moments from the program's start to its end.
  static std::vector<microseconds> moments(double seconds, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> of(0.0, 1.05 * seconds);
    std::vector<microseconds> all;
    for (int i = 0; i < count; ++i) all.emplace_back(static_cast<long>(1e6 * of(random)));
    return all;
  }

  // Undisturbed: its files and how long it takes.
  [[nodiscard]] std::pair<std::map<std::string, std::string>, double> undisturbed(const Arguments& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::pair result(files(), outcome.seconds);
    std::filesystem::remove_all(folder_ / "out");
    return result;
  }

  // With a plot drawn by gnuplot, pictures and exports: something of every stage.
  const Arguments whole_run_ =
      Arguments{"run", "scene.toml", "-o", "out", "--export", "csv,nc", "--size", "320x240", "--samples", "16"} + quick_;
};

TEST_F(Signals, AtAnyTimeEndARunCleanly) {
  const auto [whole, seconds] = undisturbed(whole_run_);
  int ended = 0;
  constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
  unsigned turn = 0;
  for (const microseconds moment : moments(seconds, 9, 1)) {
    SCOPED_TRACE(moment.count());
    may_be_killed_ = true;  // before main, as every program
    const Outcome outcome = run(whole_run_, send_after(moment, {signals[turn++ % 3]}));
    may_be_killed_ = false;
    EXPECT_TRUE(outcome.status == 130 || outcome.status == 0 ||
                (outcome.status == -1 && !std::filesystem::exists(folder_ / "out")))
        << outcome.status << outcome.err;
    for (const auto& [name, bytes] : files()) EXPECT_FALSE(name.ends_with(".tmp")) << name;
    if (outcome.status == 130) {
      ++ended;
      EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
      if (std::filesystem::exists(folder_ / "out")) {
        EXPECT_EQ(summary()["complete"], false);
        EXPECT_TRUE(exists("profile.csv") && exists("organs.csv"));
      }
    }
    std::filesystem::remove_all(folder_ / "out");
  }
  EXPECT_GT(ended, 3);
}

TEST_F(Signals, ThatKillLeaveNoFileHalfWritten) {
  const auto [whole, seconds] = undisturbed(whole_run_);
  may_be_killed_ = true;
  for (const microseconds moment : moments(seconds, 9, 2)) {
    SCOPED_TRACE(moment.count());
    const Outcome outcome = run(whole_run_, send_after(moment, {SIGKILL}));
    if (outcome.status != 0) {
      expect_whole_after_kill(whole);
      folder_.write("other.csv.12.tmp", "mine");
    }
  }
  // Into the same folder: what was left aside goes.
  EXPECT_EQ(run(whole_run_).status, 0);
  const auto last = files();
  EXPECT_EQ(last.size(), whole.size());
  for (const auto& [name, bytes] : whole) EXPECT_TRUE(name == "summary.json" || last.at(name) == bytes) << name;
}

TEST_F(Signals, TheSecondOfAKindForcesTheEnd) {
  may_be_killed_ = true;
  const auto watch = [this, sent = 0](pid_t child, const std::string&) mutable {
    if (sent < 2 && exists("summary.json")) {
      ::kill(child, SIGINT);
      ++sent;
    }
  };
  // Drawing so large a picture lasts longer than until the second.
  const Outcome outcome =
      run({"run", "scene.toml", "-o", "out", "--device", "cpu", "--grid", "0.0005", "--passes", "64"}, watch);
  EXPECT_TRUE(outcome.status == -1 || outcome.status == 130) << outcome.status;
  EXPECT_EQ(summary()["complete"], false);
}

TEST_F(Signals, AtAnyTimeLeaveADayToBeResumed) {
  const auto [whole, seconds] = undisturbed(day_);
  may_be_killed_ = true;
  for (const int signal : {SIGKILL, SIGTERM}) {
    for (const microseconds moment : moments(seconds, 4, 3)) {
      SCOPED_TRACE(moment.count());
      static_cast<void>(run(day_, send_after(moment, {signal})));
      EXPECT_EQ(run(day_ + Arguments{"--resume"}).status, 0);
      for (const char* name : {"day.csv", "organs_day.csv", "day.nc"}) EXPECT_TRUE(file(name) == whole.at(name)) << name;
      EXPECT_EQ(summary()["complete"], true);
      EXPECT_EQ(files().size(), whole.size());
      std::filesystem::remove_all(folder_ / "out");
    }
  }
}

TEST_F(Signals, LeaveNoHalfPictureAndNoHalfMesh) {
  std::filesystem::create_directories(folder_ / "out");
  const Arguments picture =
      Arguments{"render", "scene.toml", "-o", "out/a.png", "--size", "640x480", "--samples", "8"} + quick_;
  const Arguments mesh{"maize", "-o", "out/a.glb", "--rows", "6", "--per-row", "6"};
  for (const Arguments& arguments : {picture, mesh}) {
    const Outcome undisturbed = run(arguments);
    EXPECT_EQ(undisturbed.status, 0);
    const auto whole = files();
    may_be_killed_ = true;
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
      for (const microseconds moment : moments(undisturbed.seconds, 3, 4)) {
        for (const auto& [name, bytes] : files()) std::filesystem::remove(folder_ / "out" / name);
        const Outcome outcome = run(arguments, send_after(moment, {signal}));
        for (const auto& [name, bytes] : files()) {
          EXPECT_TRUE((name.ends_with(".tmp") && signal == SIGKILL) || bytes == whole.at(name)) << name;
        }
        EXPECT_TRUE(signal == SIGKILL || outcome.status == 130 || outcome.status == 0 || outcome.status == -1)
            << outcome.status;
      }
    }
    may_be_killed_ = false;
    for (const auto& [name, bytes] : files()) std::filesystem::remove(folder_ / "out" / name);
  }
}

TEST_F(Signals, ThatAreIgnoredFromOutsideStayIgnored) {
  before_program_ = [] { std::signal(SIGHUP, SIG_IGN); };  // nohup
  const auto watch = [this](pid_t child, const std::string&) {
    if (exists("summary.json")) ::kill(child, SIGHUP);
  };
  EXPECT_EQ(run(whole_run_, watch).status, 0);
  EXPECT_EQ(summary()["complete"], true);
}

class Clocks : public FaultTest {};

TEST_F(Clocks, ThatJumpChangeNothing) {
  ASSERT_EQ(run(run_).status, 0);
  const auto whole = files();
  std::filesystem::remove_all(folder_ / "out");
  preload({{"SUNFLECK_FAULT_CLOCK", "1"}});
  ASSERT_EQ(run(run_).status, 0);
  const auto jumped = files();
  for (const auto& [name, bytes] : whole) {
    EXPECT_TRUE(name == "summary.json" || jumped.at(name) == bytes) << name;
  }
  for (const auto& [name, seconds] : summary()["seconds"].items()) {
    EXPECT_GE(seconds.get<double>(), 0.0) << name;
    EXPECT_LT(seconds.get<double>(), 60.0) << name;
  }
}

TEST_F(Clocks, ThatJumpChangeNoLimitOfTime) {
  preload({{"SUNFLECK_FAULT_CLOCK", "1"}});
  const Arguments endless{"run",  "scene.toml",     "-o",   "out",           "--device", "cpu", "--images",
                          "none", "--direct-error", "1e-7", "--max-seconds", "1"};
  const Outcome outcome = run(endless);
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("--max-seconds 1"), std::string::npos) << outcome.err;
  EXPECT_GT(summary()["direct"]["replicates"], 1);
  EXPECT_LT(outcome.seconds, 6.0);
  const Outcome day = run(Arguments{"day", "day.toml", "-o", "day", "--device", "cpu", "--images", "none", "--direct-error",
                                    "1e-7", "--max-seconds", "1"});
  EXPECT_EQ(day.status, 1) << day.err;
  EXPECT_LT(day.seconds, 6.0);
}

}  // namespace
}  // namespace sunfleck::faults

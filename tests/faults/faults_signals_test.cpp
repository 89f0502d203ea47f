// Tests signals at any time, and clocks that jump.

#include "faults/faults.h"

#include <random>

namespace sunfleck::faults {
namespace {

class Signals : public FaultTest {
 protected:
  // Runs the program and sends the signal at the `moment`-th of its writes, fsyncs and renames in the folder `out`; 0 means
  // before all of them.
  Outcome run_and_send(const Arguments& arguments, int signal, int moment) {
    may_be_killed_ = true;
    preload_signals(std::to_string(signal) + "@#" + std::to_string(moment));
    const Watch at_once = [signal, sent = false](pid_t child, const std::string&) mutable {
      if (!sent) ::kill(child, signal);
      sent = true;
    };
    Outcome outcome = run(arguments, moment == 0 ? at_once : Watch());
    preload_nothing();
    may_be_killed_ = false;
    return outcome;
  }

  // Returns moments from the first to the last, one in each of `count` equal parts.
  static std::vector<int> moments(int last, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> of(0.0, 1.0);
    std::vector<int> all;
    for (int i = 0; i < count; ++i) all.push_back(1 + static_cast<int>((i + of(random)) * last / count));
    return all;
  }

  // Runs the program undisturbed; returns its files and its number of moments.
  [[nodiscard]] std::pair<std::map<std::string, std::string>, int> undisturbed(const Arguments& arguments) {
    const std::filesystem::path journal = folder_ / "journal.txt";
    std::filesystem::remove(journal);
    preload({{"SUNFLECK_FAULT_FOLDER", (folder_ / "out").string()}, {"SUNFLECK_FAULT_JOURNAL", journal.string()}});
    const Outcome outcome = run(arguments);
    preload_nothing();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string lines = content(journal);
    std::pair result(files(), static_cast<int>(std::count(lines.begin(), lines.end(), '\n')));
    EXPECT_GT(result.second, 2);
    return result;
  }

  // Includes a plot drawn by gnuplot, pictures and exports, so that every stage has something to do.
  const Arguments whole_run_ =
      Arguments{"run", "scene.toml", "-o", "out", "--export", "csv,nc", "--size", "320x240", "--samples", "16"} + quick_;
};

TEST_F(Signals, AtAnyTimeEndARunCleanly) {
  constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};
  constexpr int count = 9;
  std::vector<int> all = moments(undisturbed(whole_run_).second, count, 1);
  all.insert(all.begin(), 0);
  int ended = 0;
  unsigned turn = 0;
  for (const int moment : all) {
    SCOPED_TRACE(moment);
    std::filesystem::remove_all(folder_ / "out");
    const Outcome outcome = run_and_send(whole_run_, signals[turn++ % std::size(signals)], moment);
    // Like every program, it may be killed before main.
    const bool not_begun = outcome.status == -1 && !std::filesystem::exists(folder_ / "out");
    EXPECT_TRUE(outcome.status == 130 || outcome.status == 0 || not_begun) << outcome.status << outcome.err;
    for (const auto& [name, bytes] : files()) EXPECT_FALSE(name.ends_with(".tmp")) << name;
    if (outcome.status != 130) continue;
    ++ended;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    if (std::filesystem::exists(folder_ / "out")) {
      EXPECT_EQ(summary()["complete"], false);
      EXPECT_TRUE(exists("profile.csv") && exists("organs.csv"));
    }
  }
  EXPECT_GT(ended, count / 2);
}

TEST_F(Signals, ThatKillLeaveNoFileHalfWritten) {
  const auto [whole, last] = undisturbed(whole_run_);
  std::filesystem::remove_all(folder_ / "out");
  int killed = 0;
  constexpr int count = 9;
  for (const int moment : moments(last, count, 2)) {
    SCOPED_TRACE(moment);
    if (run_and_send(whole_run_, SIGKILL, moment).status == 0) continue;
    ++killed;
    expect_whole_after_kill(whole);
    folder_.write("other.csv.12.tmp", "mine");
  }
  EXPECT_GT(killed, count / 2);
  // The next run into the same folder removes the files left aside.
  EXPECT_EQ(run(whole_run_).status, 0);
  const auto after = files();
  EXPECT_EQ(after.size(), whole.size());
  for (const auto& [name, bytes] : whole) EXPECT_TRUE(name == "summary.json" || after.at(name) == bytes) << name;
}

// The first signal comes as soon as the run has a summary, the second one while it writes the results it has by then.
TEST_F(Signals, TheSecondOfAKindForcesTheEnd) {
  may_be_killed_ = true;
  preload_signals(signal_at(SIGINT, "fsync .") + "," + signal_at(SIGINT, "write "));
  const Outcome outcome = run({"run", "scene.toml", "-o", "out", "--device", "cpu", "--direct-error", "1e-7"});
  EXPECT_EQ(outcome.status, -1) << outcome.err;
  EXPECT_EQ(summary()["complete"], false);
}

TEST_F(Signals, AtAnyTimeLeaveADayToBeResumed) {
  const auto [whole, last] = undisturbed(day_);
  for (const int signal : {SIGKILL, SIGTERM}) {
    for (const int moment : moments(last, 4, 3)) {
      SCOPED_TRACE(moment);
      std::filesystem::remove_all(folder_ / "out");
      static_cast<void>(run_and_send(day_, signal, moment));
      EXPECT_EQ(run(day_ + Arguments{"--resume"}).status, 0);
      for (const char* name :
           {"day.csv", "day_sums.csv", "organs_day.csv", "plants_day.csv", "season.csv", "organs_steps.nc", "day.nc"})
        EXPECT_TRUE(file(name) == whole.at(name)) << name;
      EXPECT_EQ(summary()["complete"], true);
      EXPECT_EQ(files().size(), whole.size());
    }
  }
}

TEST_F(Signals, LeaveNoHalfPictureAndNoHalfMesh) {
  std::filesystem::create_directories(folder_ / "out");
  const Arguments picture =
      Arguments{"render", "scene.toml", "-o", "out/a.png", "--size", "640x480", "--samples", "8"} + quick_;
  const Arguments mesh{"maize", "-o", "out/a.glb", "--rows", "6", "--per-row", "6"};
  for (const Arguments& arguments : {picture, mesh}) {
    const auto [whole, last] = undisturbed(arguments);
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
      for (const int moment : moments(last, 3, 4)) {
        for (const auto& [name, bytes] : files()) std::filesystem::remove(folder_ / "out" / name);
        const Outcome outcome = run_and_send(arguments, signal, moment);
        for (const auto& [name, bytes] : files()) {
          EXPECT_TRUE((name.ends_with(".tmp") && signal == SIGKILL) || bytes == whole.at(name)) << name;
        }
        EXPECT_TRUE(signal == SIGKILL || outcome.status == 130 || outcome.status == 0 || outcome.status == -1)
            << outcome.status;
      }
    }
    for (const auto& [name, bytes] : files()) std::filesystem::remove(folder_ / "out" / name);
  }
}

TEST_F(Signals, ThatAreIgnoredFromOutsideStayIgnored) {
  preload_signals(signal_at(SIGHUP, "rename summary.json"));
  before_program_ = [preloaded = before_program_] {
    preloaded();
    std::signal(SIGHUP, SIG_IGN);  // as under nohup
  };
  EXPECT_EQ(run(whole_run_).status, 0);
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
    EXPECT_LT(seconds.get<double>(), 1e6) << name << ", and no years";
  }
}

// The limit is on a steady clock of which 100 readings make a second; the time of day jumps by years.
TEST_F(Clocks, ThatJumpChangeNoLimitOfTime) {
  preload({{"SUNFLECK_FAULT_CLOCK", "1"}, {"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const Arguments endless{"--device", "cpu", "--images", "none", "--direct-error", "1e-7", "--max-seconds"};
  const Outcome outcome = run(Arguments{"run", "scene.toml", "-o", "out"} + endless + Arguments{"6"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("--max-seconds 6"), std::string::npos) << outcome.err;
  EXPECT_GT(summary()["direct"]["replicates"], 1);
  const Outcome day = run(Arguments{"day", "day.toml", "-o", "day"} + endless + Arguments{"1"});
  EXPECT_EQ(day.status, 1) << day.err;
  EXPECT_NE(day.err.find("--max-seconds 1"), std::string::npos) << day.err;
}

}  // namespace
}  // namespace sunfleck::faults

// Tests the program as the processes of an MPI job: any number of them gives the same bytes as one, even after one was killed.

#include "regression/preload.h"
#include "regression/small_scene.h"

#include <algorithm>
#include <array>
#include <map>

namespace sunfleck {
namespace {

using regression::Arguments;
using regression::content;
using regression::Outcome;
using regression::operator+;
namespace fs = std::filesystem;

const std::string day_scene =
    "[plot]\nsize = [1.0, 1.0]\n"
    "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n"
    "[sky]\nmodel = \"perez\"\n"
    "[weather]\nclear_sky = \"ineichen\"\n"
    "[[band]]\nname = \"PAR\"\n"
    "[soil]\nreflectance = 0.2\n"
    "[optics.leaf]\nreflectance = 0.3\ntransmittance = 0.2\n"
    "[[plane]]\nheight = 0.5\ncells = [4, 4]\n"
    "[[sensor]]\nname = \"a\"\nfrom = [0.5, 0.2, 0.5]\n"
    "[[geometry]]\nfile = \"leaves.obj\"\n";

class Mpi : public regression::PreloadTest {
 protected:
  Mpi() {
    folder_.write("scene.toml", regression::two_band_scene);
    folder_.write("day.toml", day_scene);
    folder_.write("leaves.obj", regression::leaves_obj);
    preload_nothing();
  }
  void preload_nothing() {
    before_program_ = [] {
      for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) ::setenv(name, "1", 1);
    };
  }

  [[nodiscard]] static Arguments alone(const Arguments& arguments) { return Arguments{SUNFLECK_ITSELF} + arguments; }
  [[nodiscard]] static Arguments by(int ranks, const Arguments& arguments) {
    return Arguments{SUNFLECK_MPIRUN, "--oversubscribe", "--bind-to", "none", "-n", std::to_string(ranks)} + alone(arguments);
  }
  [[nodiscard]] static Arguments into(const std::string& out, const Arguments& arguments) {
    return arguments + Arguments{"-o", out};
  }

  // Returns the tables of a run without MPI.
  [[nodiscard]] Files plain(const Arguments& arguments) const {
    const Outcome outcome = run(alone(into("plain", arguments)));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return csv_files("plain");
  }
  void expect_same(const Files& expected, const std::string& of) const {
    const Files found = csv_files(of);
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [name, bytes] : expected)
      EXPECT_TRUE(found.contains(name) && found.at(name) == bytes) << of << ": " << name;
    EXPECT_EQ(summary(of)["complete"], true);
    EXPECT_FALSE(exists("run_state.bin", of));
  }

  // Returns the process of a job's rank on this machine; 0 if there is none.
  [[nodiscard]] static pid_t process_of(pid_t launcher, int rank) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string number = entry.path().filename().string();
      if (number.find_first_not_of("0123456789") != std::string::npos) continue;
      const std::string variables = content(entry.path() / "environ");
      const std::string variable = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
      if (variables.find(variable + '\0') == std::string::npos || parent_of(entry.path()) != launcher) continue;
      return std::stoi(number);
    }
    return 0;
  }

  // Runs the long run by two processes into `out`, and sends the signal once a state is kept: to a rank, or to the launcher
  // (-1). The first rank, which keeps the states, halts itself when the second state gets its name, timed by a clock that
  // counts, and continues afterwards. Until then `watch` is called.
  Outcome run_and_send(int signal, int rank, const std::function<void(pid_t launcher)>& watch = {}) {
    const auto environment = before_program_;
    preload_signals(regression::signal_at(SIGSTOP, "rename run_state.bin", 2), {{"SUNFLECK_FAULT_STRIDE", "0.01"}});
    before_program_ = [environment, preloaded = before_program_] {
      environment();
      preloaded();
    };
    sent_to_ = 0;
    Outcome outcome = run(by(2, into("out", long_)), [&](pid_t launcher, const std::string&) {
      if (sent_to_ != 0) return;
      if (watch) watch(launcher);
      const pid_t keeper = process_of(launcher, 0);
      if (keeper == 0 || !is_in_state(keeper, 'T')) return;
      sent_to_ = rank < 0 ? launcher : process_of(launcher, rank);
      if (sent_to_ != 0) ::kill(sent_to_, signal);
      ::kill(keeper, SIGCONT);
    });
    preload_nothing();
    return outcome;
  }

  // Asks for little work in many replicates.
  const Arguments small_{"run", "scene.toml", "--device", "cpu", "--images", "none", "--export", "csv", "--error", "0.02"};
  const Arguments long_{"run",      "scene.toml", "--device", "cpu", "--images", "none",
                        "--export", "csv",        "--passes", "800", "--error",  "0.1"};
  const Arguments day_{"day",     "day.toml", "--device", "cpu",   "--images", "none",
                       "--error", "0.02",     "--from",   "10:00", "--to",     "14:00"};
  pid_t sent_to_ = 0;

  [[nodiscard]] static bool is_at_work(pid_t process) {
    const std::string status = content(fs::path("/proc") / std::to_string(process) / "status");
    return !status.empty() && status.find("\nState:\tZ") == std::string::npos;
  }

 private:
  [[nodiscard]] static bool is_in_state(pid_t process, char state) {
    const std::string status = content(fs::path("/proc") / std::to_string(process) / "status");
    return status.find(std::string("\nState:\t") + state) != std::string::npos;
  }
  [[nodiscard]] static pid_t parent_of(const fs::path& process) {
    const std::string status = content(process / "status");
    const std::size_t line = status.find("\nPPid:");
    return line == std::string::npos ? 0 : std::stoi(status.substr(line + 6));
  }
};

TEST_F(Mpi, GivesTheTablesOfThePlainProgram) {
  const Files expected = plain(small_);
  EXPECT_EQ(expected.size(), 8U);  // organs, plants, profile, sensors, their means, triangles, the map and its sunflecks
  for (const int ranks : {1, 2, 3}) {
    const std::string out = "by" + std::to_string(ranks);
    const Outcome outcome = run(by(ranks, into(out, small_)));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_same(expected, out);
    EXPECT_EQ(summary(out)["settings"]["ranks"], ranks);
    EXPECT_EQ(outcome.err.find("3 ranks") != std::string::npos, ranks == 3) << outcome.err;
  }
}

TEST_F(Mpi, GivesTheSameDay) {
  const Files expected = plain(day_);
  // The steps; the sums of each date, and by organ, plant and kind of organ; the planes' and the sensors' steps and sums.
  EXPECT_EQ(expected.size(), 11U);
  const std::string fields = file("day.nc", "plain"), organs = file("organs_steps.nc", "plain");
  for (const int ranks : {2, 3}) {
    const std::string out = "by" + std::to_string(ranks);
    const Outcome outcome = run(by(ranks, into(out, day_)));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_same(expected, out);
    EXPECT_TRUE(file("day.nc", out) == fields);
    EXPECT_TRUE(file("organs_steps.nc", out) == organs);
  }
}

TEST_F(Mpi, GivesTheSameDayOfStepsTogether) {
  const Arguments together = day_ + Arguments{"--together", "3"};
  const Files expected = plain(together);
  const std::string out = "by2";
  const Outcome outcome = run(by(2, into(out, together)));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expect_same(expected, out);
}

TEST_F(Mpi, GoesOnAfterAnyRankWasKilled) {
  const Files expected = plain(long_);
  may_be_killed_ = true;
  for (const int rank : {0, 1}) {
    const Outcome killed = run_and_send(SIGKILL, rank);
    ASSERT_NE(sent_to_, 0) << killed.err;
    EXPECT_NE(killed.status, 0);
    EXPECT_NE(killed.err.find("rank " + std::to_string(rank)), std::string::npos) << killed.err;
    EXPECT_EQ(summary()["complete"], false);
    ASSERT_TRUE(exists("run_state.bin"));
    const Arguments again = into("out", long_) + Arguments{"--resume"};
    const Outcome resumed = run(rank == 0 ? by(3, again) : alone(again));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_NE(resumed.err.find("resuming after "), std::string::npos) << resumed.err;
    expect_same(expected, "out");
  }
}

TEST_F(Mpi, EndsCleanlyWhenOneRankIsToldTo) {
  const Outcome ended = run_and_send(SIGTERM, 1);
  ASSERT_NE(sent_to_, 0) << ended.err;
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_NE(ended.err.find("interrupted after "), std::string::npos) << ended.err;
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(csv_files("out").size(), 6U);  // a stopped run does not trace its sensors
}

// The launcher gives its processes a second; none of them may outlive it.
TEST_F(Mpi, LeavesNothingBehindButAStateAfterCtrlC) {
  pid_t worker = 0;
  const Outcome ended = run_and_send(SIGINT, -1, [&worker](pid_t launcher) {
    if (worker == 0) worker = process_of(launcher, 1);
  });
  ASSERT_NE(sent_to_, 0) << ended.err;
  EXPECT_NE(ended.status, 0);
  EXPECT_TRUE(exists("run_state.bin"));
  // The process that adopted it may not have reaped it yet.
  for (int wait = 0; is_at_work(worker) && wait < 60000; ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(is_at_work(worker));
}

TEST_F(Mpi, SaysWhatIsWrongOnce) {
  const auto lines = [](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find("sunfleck: "); at != std::string::npos; at = text.find("sunfleck: ", at + 1)) ++count;
    return count;
  };
  const std::map<std::string, std::pair<Arguments, int>> cases{
      {"--bogus (", {{"run", "scene.toml", "--bogus"}, 2}},  // fails before MPI is started, the next case after that
      {"no such device", {{"run", "scene.toml", "-o", "out", "--device", "no such device"}, 3}}};
  for (const auto& [names, failing] : cases) {
    const Outcome outcome = run(by(3, failing.first));
    EXPECT_EQ(outcome.status, failing.second) << outcome.err;
    EXPECT_EQ(lines(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find(names), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Mpi, LeavesOtherCommandsToTheFirstRank) {
  const Outcome version = run(by(3, {"--version"}));
  EXPECT_EQ(version.status, 0) << version.err;
  EXPECT_EQ(std::count(version.out.begin(), version.out.end(), '\n'), 1) << version.out;
  const Outcome info = run(by(2, {"info", "scene.toml", "--json"}));
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(nlohmann::json::accept(info.out)) << info.out;
}

// Starts independent runs, one on each rank.
TEST_F(Mpi, IsNotUsedWhereItIsSwitchedOff) {
  folder_.write("other.toml", regression::two_band_scene + "scale = 0.5\n");
  const std::string task =
      "SUNFLECK_MPI=off exec \"$0\" run $([ $OMPI_COMM_WORLD_RANK = 0 ] && echo scene.toml || echo other.toml)"
      " --device cpu --images none --error 0.1 --quiet";
  const Arguments launcher = by(2, {});
  const Outcome farm = run(Arguments(launcher.begin(), launcher.end() - 1) + Arguments{"/bin/sh", "-c", task, SUNFLECK_ITSELF});
  EXPECT_EQ(farm.status, 0) << farm.err;
  for (const char* name : {"scene", "other"}) {
    EXPECT_EQ(summary(std::string("results/") + name)["complete"], true);
    EXPECT_EQ(summary(std::string("results/") + name)["settings"]["ranks"], 1);
  }
  const Outcome joined = run(Arguments(launcher.begin(), launcher.end() - 1) +
                             Arguments{"/bin/sh", "-c", task.substr(task.find("exec")), SUNFLECK_ITSELF});
  EXPECT_EQ(joined.status, 2) << joined.err;
  EXPECT_NE(joined.err.find("SUNFLECK_MPI=off"), std::string::npos) << joined.err;
}

// Ranks with other options would make replicates of other light, or results that nobody writes.
TEST_F(Mpi, RefusesRanksWithOtherTasks) {
  const Arguments launcher = by(2, {});
  const auto farm = [&](const std::string& first, const std::string& second) {
    const std::string task = "exec \"$0\" $([ $OMPI_COMM_WORLD_RANK = 0 ] && echo " + first + " || echo " + second +
                             ") --device cpu "
                             "--images none --error 0.1 --quiet";
    return run(Arguments(launcher.begin(), launcher.end() - 1) + Arguments{"/bin/sh", "-c", task, SUNFLECK_ITSELF});
  };
  for (const auto& [first, second, words] :
       {std::array<const char*, 3>{"run scene.toml", "run scene.toml --seed 2", "with seed 2"},
        {"run scene.toml", "run scene.toml -o two", "into two"},
        {"day day.toml --from 10:00 --to 12:00", "day day.toml --from 10:00 --to 11:00", "10:00 to 11:00"},
        {"run day.toml", "day day.toml --from 10:00 --to 11:00", "day of "}}) {
    const Outcome outcome = farm(first, second);
    EXPECT_EQ(outcome.status, 2) << second << outcome.err;
    EXPECT_NE(outcome.err.find("rank 1 on"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace sunfleck

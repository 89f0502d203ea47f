// Tests two runs into one folder.

#include "faults/faults.h"

#include <fcntl.h>
#include <sys/file.h>

#include <sstream>

namespace sunfleck::faults {
namespace {

class Folder : public FaultTest {
 protected:
  // Starts a run that keeps its folder and continues until it is stopped.
  const Arguments long_run_{"run",  "scene.toml", "-o",   "out",       "--device", "cpu", "--direct-error",
                            "1e-7", "--images",   "none", "--threads", "1"};
  const Arguments long_day_{"day",   "day.toml",       "-o",   "out",      "--device", "cpu",       "--from", "10:00", "--to",
                            "12:00", "--direct-error", "1e-7", "--images", "none",     "--threads", "1"};

  // Runs `first`; as soon as it works in the folder, runs `second`, which has to be refused; then ends the first by `signal`.
  void expect_one_at_a_time(const Arguments& first, const Arguments& second, int signal, const std::string& sign) {
    may_be_killed_ = signal == SIGKILL;
    bool tried = false;
    const auto watch = [&](pid_t child, const std::string&) {
      if (tried || !std::filesystem::exists(folder_ / sign) || !holds_a_lock(child)) return;
      tried = true;
      ASSERT_TRUE(halt(child));
      const auto before = files();
      const Outcome refused = run_beside(second);
      expect_one_line(refused, "out (another run is writing into this folder)");
      EXPECT_EQ(refused.out, "");
      EXPECT_TRUE(files() == before) << "the second run changed something";
      ::kill(child, signal);
      ::kill(child, SIGCONT);
    };
    const Outcome outcome = run(first, watch);
    EXPECT_TRUE(tried) << outcome.err;
    EXPECT_EQ(outcome.status, signal == SIGKILL ? -1 : 130) << outcome.err;
    may_be_killed_ = false;
  }

 private:
  // Returns whether the process holds a lock: files of an earlier run may be in the folder before that.
  static bool holds_a_lock(pid_t process) {
    std::istringstream locks(content("/proc/locks"));
    std::string number, kind, mode, access;
    for (std::string line; std::getline(locks, line);) {
      pid_t holder = 0;
      if (std::istringstream(line) >> number >> kind >> mode >> access >> holder && holder == process) return true;
    }
    return false;
  }

  // Stops the process until SIGCONT, so that it changes no file meanwhile; and returns false if it has ended instead.
  static bool halt(pid_t process) {
    ::kill(process, SIGSTOP);
    siginfo_t state{};
    return ::waitid(P_PID, static_cast<id_t>(process), &state, WSTOPPED | WEXITED | WNOWAIT) == 0 &&
           state.si_code == CLD_STOPPED;
  }

  // Runs the program with its output in other files than the first run's.
  [[nodiscard]] Outcome run_beside(const Arguments& arguments) {
    const std::string out = (folder_ / "second.txt").string();
    before_program_ = [out] {
      constexpr int mode = 0600;
      ::dup2(::open((out + ".out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode), STDOUT_FILENO);
      ::dup2(::open((out + ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, mode), STDERR_FILENO);
    };
    Outcome outcome = run(arguments);
    before_program_ = {};
    outcome.out = content(out + ".out");
    outcome.err = content(out + ".err");
    return outcome;
  }
};

TEST_F(Folder, HoldsOneRunAtATime) {
  expect_one_at_a_time(long_run_, run_, SIGINT, "out/summary.json");
  expect_one_at_a_time(long_run_, day_, SIGTERM, "out/summary.json");
  EXPECT_EQ(run(run_).status, 0) << "free again";
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Folder, HoldsOneDayAtATime) {
  expect_one_at_a_time(long_day_, long_day_ + Arguments{"--resume"}, SIGINT, "out/steps/settings.json");
  expect_one_at_a_time(long_day_ + Arguments{"--resume"}, run_, SIGINT, "out/steps/settings.json");
}

TEST_F(Folder, IsFreeAfterAKilledRun) {
  expect_one_at_a_time(long_run_, run_, SIGKILL, "out/summary.json");
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(run(run_).status, 0);
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Folder, IsRefusedBeforeAnyWork) {
  std::filesystem::create_directories(folder_ / "out");
  const int held = ::open((folder_ / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  expect_one_line(run(with(run_, "run", "absent.toml")), "out (another run");
  EXPECT_TRUE(files().empty());
  ::close(held);
  EXPECT_EQ(run(run_).status, 0);
}

}  // namespace
}  // namespace sunfleck::faults

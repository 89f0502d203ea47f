// Tests resuming runs that were stopped or killed.

#include "regression/preload.h"
#include "regression/small_scene.h"

#include <algorithm>

namespace sunfleck {
namespace {

using regression::Arguments;
using regression::content;
using regression::expect_one_error;
using regression::Outcome;
using regression::signal_at;
using regression::operator+;

class Resume : public regression::PreloadTest {
 protected:
  Resume() {
    folder_.write("scene.toml", regression::two_band_scene);
    folder_.write("leaves.obj", regression::leaves_obj);
  }

  void expect_same_tables(const std::string& left, const std::string& right) const {
    const auto expected = csv_files(left);
    EXPECT_GE(expected.size(), 6U);
    const auto found = csv_files(right);
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [name, bytes] : expected) EXPECT_TRUE(found.contains(name) && found.at(name) == bytes) << name;
  }

  // Sends the signal when a state is renamed for the `count`-th time. A clock that advances with each reading makes that happen
  // every few replicates.
  void send_as_state_is_kept(int signal, int count) {
    preload_signals(signal_at(signal, "rename run_state.bin", count), {{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  }

  Outcome go(const Arguments& more, int status = 0, const std::string& to = "out") const {
    return simulate("scene.toml", work_ + more, status, to);
  }

  // Asks for many replicates.
  const Arguments work_{"--device", "cpu", "--images", "none", "--export", "csv", "--passes", "800", "--error", "0.1"};
};

TEST_F(Resume, GoesOnWhereItWasKilledAndStopped) {
  EXPECT_NE(go({}, 0, "whole").err.find("device: "), std::string::npos);
  EXPECT_FALSE(exists("run_state.bin", "whole"));
  may_be_killed_ = true;
  send_as_state_is_kept(SIGKILL, 2);
  go({}, -1);
  EXPECT_EQ(summary()["complete"], false);
  send_as_state_is_kept(SIGKILL, 7);
  go({"--resume"}, -1);
  may_be_killed_ = false;
  send_as_state_is_kept(SIGINT, 5);
  const Outcome stopped = go({"--resume"}, 130);
  preload_nothing();
  EXPECT_NE(stopped.err.find("--resume continues the run"), std::string::npos) << stopped.err;
  const auto replicates = summary()["direct"]["replicates"].get<int>();
  EXPECT_GT(replicates, 2);
  // Ctrl-C loses no finished replicate.
  const Outcome last = go({"--resume"});
  EXPECT_NE(last.err.find("resuming after " + std::to_string(replicates) + " replicates"), std::string::npos) << last.err;
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_FALSE(exists("run_state.bin"));
  expect_same_tables("whole", "out");
  const Outcome again = go({"--resume"});
  EXPECT_NE(again.err.find("this run is finished, nothing to resume"), std::string::npos) << again.err;
  expect_same_tables("whole", "out");
}

// --resume is given from the start, so that the clock determines no work. Twelve seconds are 1200 readings of this clock.
TEST_F(Resume, GoesOnAfterALimitOfTime) {
  go({}, 0, "whole");
  preload({{"SUNFLECK_FAULT_STRIDE", "0.01"}});
  const Outcome stopped = go({"--resume", "--max-seconds", "12"}, 1);
  preload_nothing();
  EXPECT_NE(stopped.err.find("--max-seconds 12"), std::string::npos) << stopped.err;
  EXPECT_TRUE(exists("run_state.bin"));
  EXPECT_NE(go({"--resume", "--max-seconds", "1e9"}).err.find("resuming after "), std::string::npos);
  expect_same_tables("whole", "out");
}

TEST_F(Resume, BeginsAnewWhereNothingIsKept) {
  const Outcome outcome =
      simulate("scene.toml", Arguments{"--device", "cpu", "--images", "none", "--passes", "8", "--error", "0.1", "--resume"});
  EXPECT_NE(outcome.err.find("out: nothing to resume, the run starts from the beginning"), std::string::npos) << outcome.err;
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Resume, GoesOnWithTheSameSettingsOnly) {
  send_as_state_is_kept(SIGINT, 1);
  go({}, 130);
  preload_nothing();
  const auto before = csv_files("out");
  const std::string state = file("run_state.bin");
  const Arguments again = Arguments{"run", "scene.toml", "-o", "out", "--resume"} + work_;
  const auto changed = [&](const std::string& option, const std::string& value) {
    Arguments other = again;
    *std::next(std::find(other.begin(), other.end(), option)) = value;
    return other;
  };
  expect_one_error(run(again + Arguments{"--seed", "2"}), 2, "that run has other settings: seed was 1, now 2");
  expect_one_error(run(changed("--passes", "801")), 2, "passes was 800, now 801");
  expect_one_error(run(changed("--error", "0.2")), 2, "direct_error was 0.1, now 0.2");
  Arguments coarse = again;
  const auto exports = std::find(coarse.begin(), coarse.end(), "--export");
  coarse.erase(exports, exports + 2);
  expect_one_error(run(coarse), 2, "the light of triangles for --export and --images was true, now false");
  folder_.write("leaves.obj", regression::leaves_obj + "f 1 2 4\n");
  expect_one_error(run(again), 2, "the scene, or a file that it names, has changed since that run");
  folder_.write("leaves.obj", regression::leaves_obj);
  std::string damaged = state;
  damaged[damaged.size() / 2] ^= 1;
  folder_.write("out/run_state.bin", damaged);
  expect_one_error(run(again), 2, "out/run_state.bin (it is damaged)");
  folder_.write("out/run_state.bin", state);
  EXPECT_TRUE(csv_files("out") == before);
  // The resumed run may export another table of the triangles.
  EXPECT_EQ(run(changed("--export", "nc")).status, 0);
  EXPECT_TRUE(exists("results.nc"));
  EXPECT_FALSE(exists("triangles.csv")) << "of the run that was stopped";
}

TEST_F(Resume, TakesAFinishedRunForWhatItIs) {
  const Arguments quick{"run",      "scene.toml", "-o",       "out", "--device", "cpu",
                        "--images", "none",       "--passes", "8",   "--error",  "0.1"};
  ASSERT_EQ(run(quick + Arguments{"--export", "csv"}).status, 0);
  const Arguments again = quick + Arguments{"--resume"};
  expect_one_error(run(again + Arguments{"--seed", "2"}), 2, "that finished run has other settings: seed was 1, now 2");
  expect_one_error(run(again + Arguments{"--export", "csv,nc"}), 2,
                   "--export nc (the run in out is finished, and has no results.nc)");
  Arguments with_picture = again;
  *std::find(with_picture.begin(), with_picture.end(), "none") = "rank_total";
  const Outcome lacking = run(with_picture);
  EXPECT_EQ(lacking.status, 0);
  EXPECT_NE(lacking.err.find("the run in out is finished, and has no rank_total.png"), std::string::npos) << lacking.err;
  const Outcome printed = run(again + Arguments{"--json"});
  EXPECT_EQ(printed.status, 0);
  EXPECT_EQ(printed.out, file("summary.json"));
}

}  // namespace
}  // namespace sunfleck

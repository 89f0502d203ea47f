// Tests a machine that runs out of memory.

#include "faults/faults.h"

namespace sunfleck::faults {
namespace {

class Memory : public FaultTest {
 protected:
  void give(std::size_t megabytes) {
    before_program_ = [megabytes] {
      const rlimit limit{megabytes << 20U, megabytes << 20U};
      ::setrlimit(RLIMIT_AS, &limit);
    };
  }
};

// Uses the CPU path, which has no driver's compiler in the process: that compiler ends the program itself when it gets no
// memory.
TEST_F(Memory, ThatIsShortEndsInOneLine) {
  const Arguments large{"run",    "large.toml", "-o",       "out", "--device", "cpu",         "--threads", "2",
                        "--grid", "0.02",       "--passes", "8",   "--images", "rank_direct", "--export",  "csv,nc,vtp,glb,ply",
                        "--size", "1024x1024"};
  std::string scene = small_scene;
  scene.replace(scene.find("file = \"leaves.obj\""), 19, "generator = \"maize\"\nrows = 2\nper_row = 2\nspacing = [0.3, 0.3]");
  folder_.write("large.toml", scene + "[optics.stem]\nreflectance = 0.1\n");
  ASSERT_EQ(run(large).status, 0);
  const auto whole = files();
  int failed = 0;
  int finished = 0;
  for (std::size_t megabytes = 100; megabytes <= 1600 && finished < 1; megabytes += 75) {
    SCOPED_TRACE(megabytes);
    std::filesystem::remove_all(folder_ / "out");
    give(megabytes);
    const Outcome outcome = run(large);
    if (outcome.status == 127) continue;  // not even its libraries fit into memory
    if (outcome.status == 0) {
      ++finished;
      continue;
    }
    ++failed;
    expect_one_line(outcome, "memory");
    expect_whole(whole);
  }
  EXPECT_GT(failed, 1);
  EXPECT_GT(finished, 0);
}

}  // namespace
}  // namespace sunfleck::faults

// Tests what a power cut must not destroy: every file is on the disk before it gets its name, and its name before the next file
// is begun.

#include "faults/faults.h"

#include <sstream>

namespace sunfleck::faults {
namespace {

class Durability : public FaultTest {
 protected:
  using Journal = std::vector<std::string>;

  // Records what the program does with the files of the folder `out`.
  void keep_journal(std::map<std::string, std::string> more = {}) {
    std::filesystem::remove(journal_);
    more["SUNFLECK_FAULT_FOLDER"] = (folder_ / "out").string();
    more["SUNFLECK_FAULT_JOURNAL"] = journal_.string();
    preload(more);
  }
  [[nodiscard]] Journal journal() const {
    std::istringstream lines(content(journal_));
    Journal all;
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    return all;
  }

  void fail_to_sync(const std::string& name, int code) {
    keep_journal({{"SUNFLECK_FAULT_FSYNC", name}, {"SUNFLECK_FAULT_ERRNO", std::to_string(code)}});
  }

  // Returns the name of the folder that contains `name`, as in the journal.
  static std::string parent(const std::string& name) {
    const std::string path = std::filesystem::path(name).parent_path().string();
    return path.empty() ? "." : path;
  }

  // Checks each renaming of a file to `name`: all of its bytes must have been written and synced before, and its folder must be
  // synced before anything else is renamed. Returns the number of renamings.
  static int times_made_durable(const Journal& journal, const std::string& name) {
    int times = 0;
    for (std::size_t i = 0; i < journal.size(); ++i) {
      std::istringstream words(journal[i]);
      std::string what, aside, place;
      words >> what >> aside >> place;
      if (what != "rename" || place != name) continue;
      ++times;
      const auto here = journal.begin() + static_cast<std::ptrdiff_t>(i);
      const auto before = std::make_reverse_iterator(here);
      const auto synced = std::find(before, journal.rend(), "fsync " + aside);
      const auto written = std::find(before, journal.rend(), "write " + aside);
      EXPECT_NE(synced, journal.rend()) << "no fsync before: " << journal[i];
      EXPECT_NE(written, journal.rend()) << journal[i];
      EXPECT_LT(synced - before, written - before) << "written after fsync: " << journal[i];
      const auto next_rename =
          std::find_if(here + 1, journal.end(), [](const std::string& line) { return line.starts_with("rename "); });
      EXPECT_NE(std::find(here + 1, next_rename, "fsync " + parent(name)), next_rename) << "no fsync after: " << journal[i];
    }
    return times;
  }

  void expect_all_durable() const {
    const Journal all = journal();
    int found = 0;
    for (const auto& [name, bytes] : files()) {
      EXPECT_GE(times_made_durable(all, name), 1) << name << " was not renamed into its place";
      ++found;
    }
    EXPECT_GE(found, 4);
  }

  // Sends SIGINT as soon as `now` holds for the program's output so far.
  template <class Condition>
  static Watch stop_once(Condition now) {
    return [now, stopped = false](pid_t child, const std::string& err) mutable {
      if (stopped || !now(err)) return;
      stopped = true;
      ::kill(child, SIGINT);
    };
  }

  // Asks for many short replicates, so that the run can be stopped between them; the state may be written after each.
  const Arguments endless_{"run",      "scene.toml", "-o",      "out",  "--device", "cpu",
                           "--passes", "65536",      "--error", "0.05", "--images", "none"};

  std::filesystem::path journal_ = folder_ / "journal.txt";
};

TEST_F(Durability, OfAllFilesOfARun) {
  keep_journal();
  const Outcome outcome = run(with(with(run_, "--export", "csv,nc,vtp,glb,ply"), "--images", "all"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"summary.json", "organs.csv", "results.nc", "canopy.vtp", "rank_total.png", "pictures.cbor"}) {
    EXPECT_TRUE(exists(name)) << name;
  }
  expect_all_durable();
  EXPECT_GE(times_made_durable(journal(), "summary.json"), 2) << "at the beginning, and at the end";
}

TEST_F(Durability, OfAllFilesOfADay) {
  keep_journal();
  const Outcome outcome = run(with(day_, "--images", "all"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"summary.json", "day.csv", "season.csv", "organs_steps.nc", "day.nc", "steps/settings.json"})
    EXPECT_TRUE(exists(name)) << name;
  expect_all_durable();
  EXPECT_GE(times_made_durable(journal(), "steps/step_00000.bin"), 1);
  EXPECT_GE(times_made_durable(journal(), "steps/settings.json"), 2) << "at the beginning, and at the end";
}

TEST_F(Durability, OfPicturesAndMeshes) {
  std::filesystem::create_directories(folder_ / "out");
  keep_journal();
  for (const char* name : {"a.png", "a.exr"}) {
    EXPECT_EQ(
        run(Arguments{"render", "scene.toml", "-o", std::string("out/") + name, "--size", "64x64", "--quiet"} + quick_).status,
        0);
  }
  EXPECT_EQ(run({"maize", "-o", "out/a.glb", "--rows", "1", "--per-row", "1"}).status, 0);
  EXPECT_EQ(run({"convert", "leaves.obj", "out/a.ply"}).status, 0);
  expect_all_durable();
}

TEST_F(Durability, OfTheStateOfARun) {
  keep_journal();
  const Outcome outcome = run(endless_, stop_once([this](const std::string&) { return exists("run_state.bin"); }));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_GE(times_made_durable(journal(), "run_state.bin"), 1);
}

TEST_F(Durability, OfAFolderThatIsNew) {
  const std::string out = (folder_ / "new").string();
  preload({{"SUNFLECK_FAULT_FOLDER", out}, {"SUNFLECK_FAULT_JOURNAL", journal_.string()}});
  EXPECT_EQ(run(with(run_, "-o", "new/folder")).status, 0);
  const Journal all = journal();
  const auto first_write = std::find_if(all.begin(), all.end(), [](const std::string& l) { return l.starts_with("write "); });
  EXPECT_NE(std::find(all.begin(), first_write, "fsync ."), first_write) << "its entry in the folder above";
}

TEST_F(Durability, ThatFailsIsAFailureOfTheFile) {
  const std::map<int, std::string> reasons = {{EIO, "Input/output error"}, {ENOSPC, "No space left on device"}};
  for (const auto& [code, reason] : reasons) {
    for (const std::string name : {"organs.csv", "results.nc", "rank_direct.png"}) {
      SCOPED_TRACE(name + ": " + reason);
      fail_to_sync(name, code);
      const Outcome outcome = run(run_);
      expect_one_line(outcome, "out/" + name + ": cannot be written (" + reason + ")");
      EXPECT_EQ(summary()["not_written"], nlohmann::json::array({name}));
      EXPECT_EQ(summary()["complete"], false);
      EXPECT_FALSE(exists(name));
      for (const auto& [left, bytes] : files()) EXPECT_FALSE(left.ends_with(".tmp")) << left;
      std::filesystem::remove_all(folder_ / "out");
    }
  }
  fail_to_sync("steps/step_day.nc.tmp", EIO);
  expect_one_line(run(day_), "out/day.nc: cannot be written (Input/output error); check the disk");
  fail_to_sync("steps/step_00000.bin", EIO);
  expect_one_line(run(day_), "out/steps/step_00000.bin: cannot be written (Input/output error); check the disk");
  fail_to_sync("summary.json", EIO);
  expect_one_line(run(run_), "out/summary.json: cannot be written (Input/output error)");
}

TEST_F(Durability, OfAStateThatFailsIsSaidAndTheRunGoesOn) {
  fail_to_sync("run_state.bin", ENOSPC);
  const std::string warning = "out/run_state.bin: cannot be written (No space left on device); free some space";
  const Outcome outcome = run(endless_, stop_once([&](const std::string& err) { return err.find(warning) != err.npos; }));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("the run continues"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("run_state.bin"));
  EXPECT_TRUE(exists("organs.csv"));
}

TEST_F(Durability, OfAFolderThatFails) {
  fail_to_sync(".", EIO);
  expect_one_line(run(run_), "out/summary.json: cannot be written (Input/output error); check the disk");
}

// Some network file systems do not support fsync; their files are written nevertheless.
TEST_F(Durability, ThatAFileSystemDoesNotKnowIsNoFailure) {
  for (const int code : {EINVAL, ENOTSUP}) {
    for (const char* name : {".", "organs.csv"}) {
      fail_to_sync(name, code);
      const Outcome outcome = run(run_);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_TRUE(exists("organs.csv"));
      EXPECT_EQ(summary()["complete"], true);
      std::filesystem::remove_all(folder_ / "out");
    }
  }
}

}  // namespace
}  // namespace sunfleck::faults

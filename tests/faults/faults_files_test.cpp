// Tests disks that fill up, folders and files that must not be written, and output that cannot be delivered.

#include "faults/faults.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/stat.h>

#include <cstring>

namespace sunfleck::faults {
namespace {

class Files : public FaultTest {
 protected:
  ~Files() override {
    for (const std::string& mounted : mounted_) ::umount2(mounted.c_str(), MNT_DETACH);
  }

  // Returns false where this user may not mount.
  bool mount_small_disk(const std::string& name, const char* options) {
    std::filesystem::create_directories(folder_ / name);
    const std::string path = (folder_ / name).string();
    if (::mount("tmpfs", path.c_str(), "tmpfs", 0, options) != 0) return false;
    mounted_.push_back(path);
    return true;
  }

  // Makes root respect permissions by dropping the capability to ignore them.
  void heed_permissions() {
    before_program_ = [] { ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE); };
  }

  [[nodiscard]] std::map<std::string, std::string> undisturbed(const Arguments& arguments) {
    before_program_ = {};
    EXPECT_EQ(run(arguments).status, 0);
    std::map<std::string, std::string> all = files();
    std::filesystem::remove_all(folder_ / "out");
    return all;
  }

 private:
  std::vector<std::string> mounted_;
};

TEST_F(Files, AFullDiskKeepsWhatFits) {
  const auto whole = undisturbed(run_);
  const std::size_t all = size_of(whole);
  constexpr std::size_t first = 40;   // the summary of a run that has begun
  constexpr std::size_t last = 1000;  // within the last summary, whose seconds have more or fewer digits from run to run
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{10}, first, all / 50, all / 10, all / 4, all / 2, all - last}) {
    SCOPED_TRACE(bytes);
    fill_disk_after(bytes);
    const Outcome outcome = run(run_);
    expect_one_line(outcome, "No space left on device");
    EXPECT_NE(outcome.err.find("out/"), std::string::npos) << outcome.err;
    expect_whole(whole);
    // The run fails before any ray, or after it has printed the balance.
    EXPECT_EQ(outcome.out.find("absorbed by vegetation") != std::string::npos, bytes >= first) << outcome.out;
    std::filesystem::remove_all(folder_ / "out");
  }
}

TEST_F(Files, WhatWasNotWrittenIsInTheSummary) {
  const auto whole = undisturbed(run_);
  std::filesystem::create_directories(folder_ / "out" / "organs.csv");
  const Outcome outcome = run(run_ + Arguments{"--json"});
  expect_one_line(outcome, "out/organs.csv");
  EXPECT_NE(outcome.err.find("Is a directory"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("more could not"), std::string::npos) << outcome.err;
  EXPECT_EQ(summary()["not_written"], nlohmann::json::array({"organs.csv"}));
  EXPECT_EQ(summary()["complete"], false);
  EXPECT_EQ(summary()["stopped"], "work done");
  EXPECT_EQ(outcome.out, file("summary.json"));
  std::filesystem::remove(folder_ / "out" / "organs.csv");
  for (const auto& [name, bytes] : whole) EXPECT_TRUE(exists(name) || name == "organs.csv") << name;
}

TEST_F(Files, AFullDiskLeavesADayToBeResumed) {
  const auto whole = undisturbed(day_);
  const auto tables = {"day.csv",    "day_sums.csv",    "organs_day.csv", "plants_day.csv",
                       "season.csv", "organs_steps.nc", "day.nc"};
  for (const std::size_t bytes : {3000U, 4500U, 6000U, 9000U, 14000U, 30000U}) {
    SCOPED_TRACE(bytes);
    fill_disk_after(bytes);
    const Outcome outcome = run(day_);
    expect_one_line(outcome, "No space left on device");
    EXPECT_NE(outcome.err.find("--resume"), std::string::npos) << outcome.err;
    expect_whole(whole);
    before_program_ = {};
    EXPECT_EQ(run(day_ + Arguments{"--resume"}).status, 0);
    for (const char* name : tables) EXPECT_TRUE(file(name) == whole.at(name)) << name;
    EXPECT_EQ(summary()["complete"], true);
    std::filesystem::remove_all(folder_ / "out");
  }
}

TEST_F(Files, AFullDiskLeavesNoPictureAndNoMesh) {
  std::filesystem::create_directories(folder_ / "out");
  fill_disk_after(500);
  expect_one_line(run(Arguments{"render", "scene.toml", "-o", "out/a.png", "--size", "64x64"} + quick_), "out/a.png");
  expect_one_line(run(Arguments{"render", "scene.toml", "-o", "out/a.exr", "--size", "64x64"} + quick_), "out/a.exr");
  expect_one_line(run({"maize", "-o", "out/a.glb", "--rows", "1", "--per-row", "1"}), "out/a.glb");
  EXPECT_TRUE(files().empty());
}

TEST_F(Files, ASmallDisk) {
  if (!mount_small_disk("out", "size=96k")) GTEST_SKIP() << "no right to mount a small disk: " << std::strerror(errno);
  const Outcome outcome = run(with(run_, "--size", "800x600"));
  expect_one_line(outcome, "No space left on device");
  EXPECT_TRUE(exists("profile.csv"));
  EXPECT_EQ(summary()["complete"], false);
  for (const auto& [name, bytes] : files()) EXPECT_FALSE(name.ends_with(".tmp")) << name;
  expect_one_line(run(day_ + Arguments{"--step", "2"}), "No space left on device");
}

TEST_F(Files, ALimitOfFileSizesIsNamed) {
  before_program_ = [] {
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  const Outcome outcome = run(run_);
  expect_one_line(outcome, "File too large");
  EXPECT_NE(outcome.err.find("ulimit -f"), std::string::npos) << outcome.err;
  EXPECT_TRUE(exists("organs.csv"));
  EXPECT_EQ(summary()["complete"], false);
  expect_one_line(run({"maize", "-o", "a.glb", "--rows", "1", "--per-row", "1"}), "a.glb");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.glb"));
  expect_one_line(run(with(day_, "-o", "day")), "File too large");
}

TEST_F(Files, AReadOnlyFolder) {
  std::filesystem::create_directories(folder_ / "locked");
  ::chmod((folder_ / "locked").c_str(), 0555);
  heed_permissions();
  for (const char* folder : {"locked", "locked/new"}) {
    SCOPED_TRACE(folder);
    expect_one_line(run(Arguments{"run", "scene.toml", "-o", folder} + quick_), "locked");
    expect_one_line(run(Arguments{"day", "day.toml", "-o", folder} + quick_), "locked");
  }
  expect_one_line(run(Arguments{"render", "scene.toml", "-o", "locked/a.png"} + quick_), "locked/a.png");
  expect_one_line(run({"maize", "-o", "locked/a.glb"}), "locked/a.glb");
  EXPECT_TRUE(files("locked").empty());
  ::chmod((folder_ / "locked").c_str(), 0755);
}

TEST_F(Files, ADiskThatIsReadOnly) {
  if (!mount_small_disk("disk", "size=64k,ro")) GTEST_SKIP() << "no right to mount a small disk: " << std::strerror(errno);
  for (const char* folder : {"disk", "disk/new"}) {
    expect_one_line(run(Arguments{"run", "scene.toml", "-o", folder} + quick_), "Read-only file system");
  }
  expect_one_line(run({"maize", "-o", "disk/a.glb"}), "Read-only file system");
}

TEST_F(Files, AWriteProtectedFileStays) {
  const auto whole = undisturbed(run_);
  std::filesystem::create_directories(folder_ / "out");
  heed_permissions();
  for (const char* name : {"summary.json", "organs.csv", "hue_total.png"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path kept = folder_.write(std::string("out/") + name, "mine");
    ::chmod(kept.c_str(), 0444);
    expect_one_line(run(run_), std::string("out/") + name);
    EXPECT_EQ(content(kept), "mine");
    ::chmod(kept.c_str(), 0644);
    std::filesystem::remove_all(folder_ / "out");
    std::filesystem::create_directories(folder_ / "out");
  }
  // In the folder of an earlier run the fault is found before any of that run's files is removed.
  EXPECT_EQ(run(run_).status, 0);
  const auto earlier = files();
  ::chmod((folder_ / "out" / "organs.csv").c_str(), 0444);
  expect_one_line(run(run_), "out/organs.csv");
  EXPECT_TRUE(files() == earlier);
}

TEST_F(Files, AFileInTheFoldersPlace) {
  folder_.write("out", "mine");
  expect_one_line(run(run_), "out");
  expect_one_line(run(day_), "out");
  expect_one_line(run(Arguments{"run", "scene.toml", "-o", "out/below"} + quick_), "out");
  expect_one_line(run(Arguments{"render", "scene.toml", "-o", "out/a.png"} + quick_), "out/a.png");
  expect_one_line(run({"maize", "-o", "out/a.glb"}), "out/a.glb");
  EXPECT_EQ(content(folder_ / "out"), "mine");
}

class Output : public FaultTest {
 protected:
  void send_output_to(const char* file) {
    before_program_ = [file] {
      const int number = ::open(file, O_WRONLY);
      ::dup2(number, STDOUT_FILENO);
    };
  }
};

TEST_F(Output, ThatCannotBePrintedIsAFailure) {
  send_output_to("/dev/full");
  expect_one_line(run(run_ + Arguments{"--json"}), "standard output");
  EXPECT_EQ(summary()["complete"], true) << "the files are there";
  expect_one_line(run({"info"}), "standard output");
  expect_one_line(run({"--help"}), "standard output");
  EXPECT_EQ(run(run_ + Arguments{"--quiet"}).status, 0) << "nothing to print";
}

TEST_F(Output, ToAStreamThatIsClosedSpoilsNoFile) {
  before_program_ = [] { ::close(STDOUT_FILENO); };
  expect_one_line(run(run_), "standard output");
  EXPECT_EQ(summary()["complete"], true);
  before_program_ = [] {
    ::close(STDIN_FILENO);
    ::close(STDOUT_FILENO);
    ::close(STDERR_FILENO);
  };
  EXPECT_EQ(run(run_ + Arguments{"--quiet"}).status, 0);
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Output, AReaderThatWantsNoMoreIsNoFailure) {
  before_program_ = [] {
    int ends[2];
    if (::pipe(ends) != 0) return;
    ::close(ends[0]);  // the reader is gone, as after `| head`
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
  };
  EXPECT_EQ(run(run_ + Arguments{"--json"}).status, 0);
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_EQ(run(run_ + Arguments{"--seed", "2"}).status, 0);
  EXPECT_EQ(summary()["seed"], 2);
  EXPECT_EQ(run(day_).status, 0);
}

}  // namespace
}  // namespace sunfleck::faults

// Tests which changes of files the window notices.

#include "programs/viewer/file_watch.h"

#include "support/scene_text.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

class Watching : public ::testing::Test {
 protected:
  Watching() {
    for (const char* name : {"scene.toml", "stand.obj"}) {
      write(folder_ / name, "one\n");
      files_.note(folder_ / name);
    }
    watch_.add(files_.list());
  }

  // Writes other content, dated `later_s` after the present one, so that even a coarse file system clock shows the change.
  void change(const std::string& name, int later_s = 1) const {
    const auto before = fs::last_write_time(folder_ / name);
    write(folder_ / name, "two\n");
    fs::last_write_time(folder_ / name, before + std::chrono::seconds(later_s));
  }

  TempFolder folder_;
  SourceFiles files_;
  FileWatch watch_;
};

TEST_F(Watching, TellsEachChangeOnce) {
  EXPECT_FALSE(watch_.has_changed());
  for (const char* name : {"scene.toml", "stand.obj"}) {
    change(name);
    EXPECT_TRUE(watch_.has_changed()) << name;
    EXPECT_FALSE(watch_.has_changed()) << name;
  }
  change("stand.obj", -3600);
  EXPECT_TRUE(watch_.has_changed()) << "an older file may have taken its place";
  watch_.clear();
  change("stand.obj");
  EXPECT_FALSE(watch_.has_changed());
}

TEST_F(Watching, SurvivesEditorsThatReplaceFiles) {
  fs::rename(folder_ / "stand.obj", folder_ / "stand.obj~");
  EXPECT_FALSE(watch_.has_changed()) << "it is away for a moment";
  fs::rename(folder_ / "stand.obj~", folder_ / "stand.obj");
  EXPECT_FALSE(watch_.has_changed()) << "it is as it was";
  fs::rename(folder_ / "stand.obj", folder_ / "stand.obj~");
  EXPECT_FALSE(watch_.has_changed());
  write(folder_ / "stand.obj", "two\n");
  EXPECT_TRUE(watch_.has_changed());
  write(folder_ / "new", "six\n");
  fs::last_write_time(folder_ / "new", fs::last_write_time(folder_ / "stand.obj"));
  fs::rename(folder_ / "new", folder_ / "stand.obj");
  EXPECT_TRUE(watch_.has_changed()) << "renamed into its place, as old and as long";
}

TEST_F(Watching, CountsFromWhenAFileWasRead) {
  SourceFiles reading;
  EXPECT_EQ(reading.read(folder_ / "stand.obj"), "one\n");
  change("stand.obj");
  reading.note(folder_ / "stand.obj");  // read a second time, after the change
  watch_.clear();
  watch_.add(reading.list());
  EXPECT_TRUE(watch_.has_changed()) << "it was changed while the scene was being read";
}

// A missing or broken file makes a scene fail; the window continues with the last good scene and waits.
TEST_F(Watching, WaitsForWhatAFailedSceneLacked) {
  SourceFiles failed;
  failed.note(folder_ / "scene.toml");
  failed.note(folder_ / "more.obj");
  watch_.add(failed.list());
  EXPECT_FALSE(watch_.has_changed());
  write(folder_ / "more.obj", "one\n");
  EXPECT_TRUE(watch_.has_changed());
  change("stand.obj");
  EXPECT_TRUE(watch_.has_changed()) << "those of the last good one are watched too";
}

// A file that was missing when the scene was read again may come back unchanged: the scene failed because it was missing.
TEST_F(Watching, ReadsAgainWhatFailedForAFileThatWasAway) {
  fs::rename(folder_ / "stand.obj", folder_ / "stand.obj~");
  SourceFiles failed;
  failed.note(folder_ / "stand.obj");
  watch_.add(failed.list());
  EXPECT_FALSE(watch_.has_changed());
  fs::rename(folder_ / "stand.obj~", folder_ / "stand.obj");
  EXPECT_TRUE(watch_.has_changed());
}

}  // namespace
}  // namespace sunfleck

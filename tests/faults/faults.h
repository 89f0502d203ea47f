#pragma once
// Runs the program while something around it fails.

#include "regression/preload.h"
#include "regression/small_scene.h"
#include "support/table.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <map>

namespace sunfleck::faults {

using regression::Arguments;
using regression::content;
using regression::Outcome;
using regression::signal_at;
using regression::operator+;

// Contains two leaves that scatter, sun and sky, a facula map and a sensor, so that every kind of file is written.
inline const std::string small_scene =
    "[plot]\nsize = [1.0, 1.0]\n"
    "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n"
    "[sky]\nmodel = \"uniform\"\n"
    "[[band]]\nname = \"PAR\"\ndirect = 100.0\ndiffuse = 20.0\n"
    "[soil]\nreflectance = 0.2\n"
    "[optics.leaf]\nreflectance = 0.3\ntransmittance = 0.2\n"
    "[[plane]]\nheight = 0.5\ncells = [4, 4]\n"
    "[[sensor]]\nname = \"a\"\nfrom = [0.5, 0.2, 0.5]\n"
    "[[geometry]]\nfile = \"leaves.obj\"\n";

inline const std::string day_scene =
    "[plot]\nsize = [1.0, 1.0]\n"
    "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n"
    "[[band]]\nname = \"PAR\"\ndirect_normal = 400.0\n"
    "[soil]\nreflectance = 0.2\n"
    "[optics.leaf]\nreflectance = 0.3\ntransmittance = 0.2\n"
    "[[geometry]]\nfile = \"leaves.obj\"\n";

// Returns the arguments with another value for an option that they contain.
inline Arguments with(Arguments arguments, const std::string& option, const std::string& value) {
  *std::next(std::find(arguments.begin(), arguments.end(), option)) = value;
  return arguments;
}

class FaultTest : public regression::PreloadTest {
 protected:
  FaultTest() {
    folder_.write("scene.toml", small_scene);
    folder_.write("day.toml", day_scene);
    folder_.write("leaves.obj", regression::leaves_obj);
  }

  // Asks for little work on the CPU path.
  const Arguments quick_{"--device", "cpu", "--grid", "0.03"};
  const Arguments run_ = Arguments{"run",        "scene.toml", "-o",    "out",      "--export",
                                   "csv,nc,vtp", "--size",     "64x64", "--images", "rank_direct,hue_total"} +
                         quick_;
  const Arguments day_ =
      Arguments{"day", "day.toml", "-o", "out", "--from", "10:00", "--to", "13:00", "--images", "none"} + quick_;

  // Expects every file to be as in an undisturbed run, and the summary to say that the run is not complete; ignores steps and
  // files that an undisturbed run does not have.
  void expect_whole(const std::map<std::string, std::string>& undisturbed) const {
    for (const auto& [name, bytes] : files()) {
      EXPECT_FALSE(name.ends_with(".tmp")) << name << " is left";
    }
    expect_files_whole(undisturbed);
    if (exists_in_out("summary.json")) {
      EXPECT_FALSE(tells_complete());
    }
  }

  // Expects the same after a kill, which may leave temporary files, and may have come between the last file and the program's
  // end: if a summary says that the run is complete, all files of a complete run must be in the same folder.
  void expect_whole_after_kill(const std::map<std::string, std::string>& undisturbed) const {
    expect_files_whole(undisturbed);
    if (!exists_in_out("summary.json") || !tells_complete()) return;
    for (const auto& [name, bytes] : undisturbed) EXPECT_TRUE(exists_in_out(name)) << name;
  }

  // Expects the failure that a user sees: one line with place, reason and remedy. Computed results may be on standard output.
  static void expect_one_line(const Outcome& outcome, const std::string& names, int status = 1) {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    const std::size_t begin = outcome.err.find("sunfleck: ");
    ASSERT_NE(begin, std::string::npos) << outcome.err;
    const std::string line = outcome.err.substr(begin);
    EXPECT_EQ(line.find('\n'), line.size() - 1) << outcome.err;
    EXPECT_NE(line.find(names), std::string::npos) << line << "does not name " << names;
    EXPECT_TRUE(line.find(" (") < line.find("); ")) << line;
    EXPECT_EQ(line.find("bug in the program"), std::string::npos) << line;
  }

  void fill_disk_after(std::size_t bytes) {
    preload({{"SUNFLECK_FAULT_FOLDER", (folder_ / "out").string()}, {"SUNFLECK_FAULT_BYTES", std::to_string(bytes)}});
  }

  [[nodiscard]] static std::size_t size_of(const std::map<std::string, std::string>& files) {
    std::size_t bytes = 0;
    for (const auto& [name, file] : files) bytes += file.size();
    return bytes;
  }

 private:
  [[nodiscard]] bool exists_in_out(const std::string& name) const { return std::filesystem::exists(folder_ / "out" / name); }

  [[nodiscard]] bool tells_complete() const {
    const std::string bytes = content(folder_ / "out" / "summary.json");
    const nlohmann::json summary = nlohmann::json::parse(bytes, nullptr, false);
    EXPECT_TRUE(summary.is_object()) << bytes;
    return summary.is_object() && summary["complete"].get<bool>();
  }

  void expect_files_whole(const std::map<std::string, std::string>& undisturbed) const {
    for (const auto& [name, bytes] : files()) {
      if (name != "summary.json" && undisturbed.contains(name) && !name.starts_with("steps/")) {
        EXPECT_TRUE(bytes == undisturbed.at(name)) << name << " differs: " << bytes.size() << " bytes";
      }
    }
  }
};

}  // namespace sunfleck::faults

// Tests that files are written whole or not at all, piece by piece too.

#include "base/file.h"

#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <limits>
#include <new>
#include <ostream>
#include <random>
#include <string>

namespace sunfleck {
namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator files(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

// As a batch system sets them: a limit of the job around a group of the process without one.
TEST(Memory, IsWhatAllControlGroupsLeave) {
  const TempFolder folder;
  const std::filesystem::path process = folder / "job" / "step";
  std::filesystem::create_directories(process);
  const auto set = [](const std::filesystem::path& group, const char* limit, const char* used) {
    write_file(group / "memory.max", limit);
    write_file(group / "memory.current", used);
  };
  EXPECT_EQ(memory_left_by_groups(folder.path(), "/job/step"), std::numeric_limits<std::uintmax_t>::max());
  set(process, "max\n", "700\n");
  set(folder / "job", "1000\n", "800\n");
  EXPECT_EQ(memory_left_by_groups(folder.path(), "/job/step"), 200U);
  EXPECT_EQ(memory_left_by_groups(folder.path(), "/"), std::numeric_limits<std::uintmax_t>::max());
  set(process, "700\n", "701\n");
  EXPECT_EQ(memory_left_by_groups(folder.path(), "/job/step"), 0U);
  set(folder.path(), "50\n", "0\n");
  EXPECT_EQ(memory_left_by_groups(folder.path(), "/job"), 50U)
      << "the root's counts where it is a group itself, as in a container";
}

TEST(File, HoldsWhatAStreamWrites) {
  const TempFolder folder;
  std::mt19937 random(1);
  std::string expected;
  write_file(folder / "a", [&](std::ostream& out) {
    for (const std::size_t bytes : {1, 100, 65535, 65536, 3, 65537, 300000, 0, 7}) {
      std::string piece(bytes, '\0');
      for (char& byte : piece) byte = static_cast<char>(random());
      out << piece;
      out.put('x');
      expected += piece + 'x';
    }
  });
  EXPECT_EQ(read_file(folder / "a"), expected);
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(File, StaysAsItWasIfItsContentCannotBeMade) {
  const TempFolder folder;
  folder.write("a", "before");
  const auto fail = [](std::ostream& out) {
    out << "after";
    throw std::bad_alloc();
  };
  EXPECT_THROW(write_file(folder / "a", fail), std::bad_alloc);
  EXPECT_EQ(read_file(folder / "a"), "before");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace
}  // namespace sunfleck

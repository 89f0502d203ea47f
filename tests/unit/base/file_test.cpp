// Tests that files are written whole or not at all, piece by piece too.

#include "base/file.h"

#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
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

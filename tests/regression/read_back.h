#pragma once
// Has programs written by others read files of this one.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace sunfleck::regression {

// Returns what a program prints to standard output; its exit status must be 0.
inline std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), [](std::FILE*) { return 0; });
  std::string text;
  std::array<char, 4096> piece{};
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe.get())) text.append(piece.data(), got);
  EXPECT_EQ(::pclose(pipe.get()), 0) << command << '\n' << text;
  return text;
}

// Returns what the script read_NAME.py in read_back/ finds in a file.
inline nlohmann::json read_back(const std::string& name, const std::filesystem::path& file) {
  const std::string script =
      "'" SUNFLECK_PYTHON "' -B '" SUNFLECK_SOURCE_DIR "/tests/regression/read_back/read_" + name + ".py'";
  nlohmann::json found = nlohmann::json::parse(output_of(script + " '" + file.string() + "'"), nullptr, false);
  EXPECT_FALSE(found.is_discarded()) << "python3-vtk9, python3-meshio, python3-netcdf4 and python3-xarray must be installed";
  return found;
}

}  // namespace sunfleck::regression

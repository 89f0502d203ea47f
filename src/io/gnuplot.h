#pragma once
// Plots through gnuplot, an optional program: without it a run lacks a picture and says so, and nothing else changes.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

struct Gnuplot {
  std::string program = "gnuplot";  // sought in PATH unless it holds a slash
  double limit_s = 60.0;            // a run that takes longer is killed
};

// Runs a script that ends in one PNG on standard output, and writes that picture aside and renames it. No shell is involved,
// the user's gnuplot settings are not read, and what does not end in time is killed. Returns, where there is no gnuplot or it
// fails, the line to warn with, else nothing. Throws Error (failure) if the file cannot be written.
[[nodiscard]] std::optional<std::string> draw_plot(std::string_view script, const std::filesystem::path& file,
                                                   const Gnuplot& gnuplot = {});

}  // namespace sunfleck

#pragma once
// Plots drawn by gnuplot, an optional program: without it a run only lacks the picture and warns about it.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

struct Gnuplot {
  std::string program = "gnuplot";  // searched in PATH unless it contains a slash
  double limit_s = 600.0;           // a gnuplot process that runs longer is killed
};

// Runs a script that writes one PNG to standard output, and saves that picture aside and renames it. No shell is involved, and
// the user's gnuplot settings are not read. Returns a warning line if gnuplot is missing, fails or is killed after the time
// limit, otherwise nothing. Throws Error (failure) if the file cannot be written.
[[nodiscard]] std::optional<std::string> draw_plot(std::string_view script, const std::filesystem::path& file,
                                                   const Gnuplot& gnuplot = {});

}  // namespace sunfleck

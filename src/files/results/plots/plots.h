#pragma once
// Plots of result tables: finds the gnuplot script of a plot and runs it with the variables that it reads.

#include "files/results/plots/gnuplot.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Returns a gnuplot string constant for any text, in which gnuplot finds nothing to execute: everything but letters, digits and
// a few signs is written as octal numbers. NUL bytes are left out, since a gnuplot string ends there.
[[nodiscard]] std::string gnuplot_text(std::string_view text);

// The variables of a script, as gnuplot commands.
class PlotVariables {
 public:
  void set(std::string_view name, double number);
  // Sets a text; control characters and broken UTF-8 are replaced as in messages.
  void set_text(std::string_view name, std::string_view text);
  void set_file(std::string_view name, const std::filesystem::path& file);
  void set_texts(std::string_view name, std::span<const std::string> texts);
  void set_files(std::string_view name, std::span<const std::filesystem::path> files);
  // Sets the data block `$name`, a comma-separated table with a line of column names.
  void set_table(std::string_view name, std::string_view columns, std::span<const std::vector<double>> rows);

  [[nodiscard]] const std::string& commands() const { return commands_; }

 private:
  std::string commands_;
};

// Returns the folder of the scripts: the one that the environment variable SUNFLECK_PLOTS names; otherwise the one installed
// with the program or the Python module; otherwise that of the source tree.
[[nodiscard]] std::filesystem::path plot_folder();

// Draws `picture` with a script of plot_folder(), such as "profile.gp". Returns a warning line if the script is not there or
// draw_plot returns one. Throws Error (failure) if the picture cannot be written.
[[nodiscard]] std::optional<std::string> draw_table(std::string_view script, const PlotVariables& variables,
                                                    const std::filesystem::path& picture, const Gnuplot& gnuplot = {});

}  // namespace sunfleck

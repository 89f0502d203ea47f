#pragma once
// Declares the commands and their options to CLI11; each function fills the plain structs of programs/cli/options.h.

#include "programs/cli/options.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace sunfleck {

// Options that are given as words and converted after parsing.
struct OptionWords {
  std::optional<double> both_errors;
  std::string size = "1600x1200";
  std::string chart = "rank", field = "total", view = "camera";
};

void add_version(CLI::App& command);

void add_run(CLI::App& app, RunOptions& options, OptionWords& words);
void add_day(CLI::App& app, DayOptions& options, OptionWords& words);
void add_render(CLI::App& app, RenderOptions& options, OptionWords& words);
void add_view(CLI::App& app, ViewOptions& options, OptionWords& words);
void add_validate(CLI::App& app, ValidateOptions& options);
void add_tradeoff(CLI::App& app, TradeoffOptions& options);
void add_maize(CLI::App& app, MaizeOptions& options);
void add_convert(CLI::App& app, ConvertOptions& options);
void add_new(CLI::App& app, NewOptions& options);
void add_info(CLI::App& app, InfoOptions& options, OptionWords& words);

}  // namespace sunfleck

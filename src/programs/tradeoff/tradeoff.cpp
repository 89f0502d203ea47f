#include "programs/tradeoff/tradeoff.h"

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "base/log.h"
#include "files/results/plots/plots.h"
#include "files/results/tables/tradeoff_table.h"
#include "physics/transport/solve/darkness.h"
#include "programs/cli/terminal.h"
#include "programs/tradeoff/tradeoff_fit.h"
#include "programs/tradeoff/tradeoff_measure.h"
#include "programs/tradeoff/tradeoff_plan.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"
#include "simulate/simulation.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

constexpr const char* table_file = "tradeoff.csv";
constexpr const char* plot_file = "tradeoff.png";

Scene read_lit_scene(const RunOptions& options) {
  Scene scene = load_scene_with_warnings(options);
  RadiationModel& model = scene.model;
  if (is_dark(model)) {
    throw_input(printable(options.scene.string()), "the scene has no light, so every run is exact",
                "give a scene with a sun above the horizon, a sky or a lamp");
  }
  model.planes.clear();
  model.sensors.clear();
  return scene;
}

// Checks before any ray is traced that the results can be written, and removes those of an earlier measurement.
void prepare(const fs::path& folder, FolderLock& lock, const TradeoffReport& report) {
  lock.make_folder();
  check_writable(folder / plot_file);
  write_file(folder / table_file, tradeoff_csv(report));
  std::error_code error;
  fs::remove(folder / plot_file, error);
}

PlotVariables plot_variables(const TradeoffReport& report, const fs::path& folder) {
  PlotVariables variables;
  variables.set_file("table", folder / table_file);
  variables.set_text("title", report.record.title);
  if (report.marked_grid_m) variables.set("grid", *report.marked_grid_m);
  if (!report.recommendation) return variables;
  variables.set("asked", report.recommendation->requested_error);
  variables.set("seconds", report.recommendation->seconds);
  variables.set("expected", report.recommendation->expected);
  return variables;
}

std::string slopes_line(const TradeoffReport& report, TradeoffSeries series, std::string_view light) {
  std::string line;
  for (const TradeoffFit& fit : report.fits) {
    if (fit.series != series) continue;
    const double half_width = fit.of_rays.half_width(report.record.accuracy.confidence);
    line += fmt::format("{} {} {:.2f}", line.empty() ? "" : ",", quantity_name(fit.quantity), fit.of_rays.exponent);
    if (std::isfinite(half_width)) line += fmt::format(" ± {:.2f}", half_width);
  }
  return line.empty() ? line : fmt::format("  error of {} light falls as rays to the power of{}\n", light, line);
}

void print_report(const TradeoffReport& report, const fs::path& folder) {
  std::string text = report.record.title + '\n' + "  " + device_line(report.record.device) + '\n';
  text += slopes_line(report, TradeoffSeries::grids, "direct");
  text += slopes_line(report, TradeoffSeries::packets, "indirect");
  if (report.recommendation) text += "  " + recommendation_line(*report.recommendation) + '\n';
  fmt::print("{}{}\n", text, folder.string());
}

void say_what_lacks(const TradeoffOptions& options, const TradeoffReport& report) {
  if (!report.record.complete) {
    const std::string why =
        interrupted() ? "interrupted" : fmt::format("stopped after --max-seconds {}", *options.run.max_seconds);
    warn(fmt::format("{} after {} settings; they are kept and marked incomplete", why, report.levels.size()));
  }
  if (!report.recommendation && report.record.complete)
    warn(fmt::format("no bound is recommended: this reference does not resolve errors near {:g} % per {}; give more --rays",
                     100.0 * options.requested_error, options.quantity));
}

}  // namespace

int tradeoff(const TradeoffOptions& options) {
  start_at_terminal(options.run);
  Stopwatch total;
  const fs::path folder =
      options.run.output.empty() ? fs::path("results") / (scene_stem(options.run.scene) + "_tradeoff") : options.run.output;
  FolderLock lock(folder);

  Scene scene = read_lit_scene(options.run);
  RunOptions run = options.run;
  run.passes = tradeoff_replicates;
  check_grid(run, scene);
  run.passes.reset();
  run.grid_m.reset();
  run.max_seconds.reset();
  run.triangle_light = true;
  SolveSettings settings = solve_settings(run, scene, run.threads);

  Simulation simulation(std::move(scene), options.run);
  TradeoffReport report;
  report.record = simulation.record(settings);
  report.record.complete = false;
  report.record.max_seconds = options.run.max_seconds;
  report.seeds = options.seeds;
  report.marked_grid_m = options.run.grid_m;
  watch_for_interrupts();
  prepare(folder, lock, report);
  say(device_line(report.record.device));

  report.record.complete = measure_tradeoff(options, settings, simulation, folder / table_file, report);
  simulation.check_validation();
  report.fits = fit_series(report.levels);
  report.recommendation = recommend(report.levels, options.requested_error, requested_quantity(options));
  report.total_seconds = total.lap();
  write_file(folder / table_file, tradeoff_csv(report));
  if (!report.levels.empty()) {
    if (const auto problem = draw_table("tradeoff.gp", plot_variables(report, folder), folder / plot_file)) warn(*problem);
  }
  say_what_lacks(options, report);
  if (options.run.json) {
    fmt::print("{}", tradeoff_json(report));
  } else if (!options.run.quiet) {
    print_report(report, folder);
  }
  if (report.record.complete) return exit_done;
  return interrupted() ? exit_interrupted : exit_short_of_bound;
}

}  // namespace sunfleck

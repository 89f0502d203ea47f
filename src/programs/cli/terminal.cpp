#include "programs/cli/terminal.h"

#include "base/file.h"
#include "files/results/tables/judged_figure.h"
#include "pictures/charts/picture.h"
#include "programs/cli/process.h"
#include "programs/cli/report.h"
#include "simulate/interrupt.h"
#include "simulate/result_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

namespace sunfleck {

namespace {

void warn_of_missing_pictures(const std::filesystem::path& folder, const RunOptions& options, std::string_view work) {
  std::vector<std::string> names;
  for (const std::string& name : options.images) {
    // The season's plot is drawn of several dates only, and planes have names of their own.
    if (name != "all" && name != "none" && name != "planes" && name != "season") names.push_back(name);
  }
  if (options.extra_picture) names.push_back(stem_of(*options.extra_picture));
  for (const std::string& name : names) {
    if (const auto lack = lack_of(folder, work, name + ".png")) warn(fmt::format("{}; {}", *lack, cure_of_lack));
  }
}

// Returns the words about a pass: "direct error 0.0037 of 0.001 (beam on vegetation)". Empty for a pass that reached its bound, has
// none, or has no light.
std::string shortfall(const char* pass, const PassError& of, const RadiationModel& model) {
  if (!of.relative_error || !of.bound || !of.judged || *of.relative_error <= *of.bound) return "";
  return fmt::format("{} error {:.2g} of {:.2g} ({})", pass, *of.relative_error, *of.bound, figure_name(*of.judged, model));
}

// Returns the part of a solver's progress that a progress line shows.
ProgressLine::State progress_state(const Progress& progress) {
  ProgressLine::State state{.rays = progress.rays, .fraction = progress.fraction, .seconds_left = progress.seconds_left};
  if (progress.stage == Progress::Stage::pilot) state.stage = "pilot";
  if (progress.stage == Progress::Stage::sensors) state.stage = "sensors";
  if (progress.relative_error) {
    state.relative_error = progress.relative_error;
    state.bound = progress.bound;
    state.error_of = pass_name(progress.pass);
  }
  return state;
}

}  // namespace

void start_at_terminal(const RunOptions& options) {
  start_log(options.quiet || options.json ? Verbosity::quiet : Verbosity::normal);
  exit_on_interrupts();
  for (const std::string& warning : options.without_effect) warn(warning);
}

std::string device_line(const TracerDevice& device) {
  return fmt::format("device: {}{}", device.name,
                     device.software && device.kind == "vulkan" ? " (software Vulkan, no GPU)" : "");
}

Monitor terminal_monitor(ProgressLine& line) {
  Monitor monitor;
  monitor.interrupted = interrupted;
  monitor.report = [&line](const Progress& progress) { line.update(progress_state(progress)); };
  return monitor;
}

SimulatedScene simulate_at_terminal(Simulation& simulation, const SolveSettings& settings, Checkpoint* checkpoint,
                                    Ranks* ranks) {
  ProgressLine line("simulating");
  SimulatedScene simulated = simulation.run(settings, {terminal_monitor(line), checkpoint, ranks});
  return_freed_memory();  // pictures and stores take as much again
  return simulated;
}

int exit_status(StopReason stop) {
  if (is_done(stop)) return exit_done;
  return stop == StopReason::interrupted ? exit_interrupted : exit_short_of_bound;
}

void warn_if_short(const SimulatedScene& simulated, const SolveSettings& settings, std::string_view outcome) {
  const RadiationResult& result = simulated.result;
  const RadiationModel& model = simulated.scene->model;
  if (is_done(result.stop)) return;
  std::string line = "interrupted";
  if (result.stop == StopReason::time_spent)
    line = fmt::format("stopped after --max-seconds {}", settings.max_seconds.value_or(0));
  if (result.stop == StopReason::replicates_spent) line = "stopped at the largest number of replicates of a run";
  if (result.stop == StopReason::rays_spent) line = fmt::format("stopped at --max-rays {}", settings.max_rays.value_or(0));
  if (result.direct.rays + result.indirect.sky_rays + result.indirect.packets == 0) {
    line += " before the first rays were counted: the tables contain no light yet";
  } else {
    line += fmt::format(" after {} replicates", result.direct.replicates);
    const std::string direct = shortfall("direct", result.direct, model);
    const std::string indirect = shortfall("indirect", result.indirect, model);
    const std::string sensors = shortfall("sensors", result.of_sensors, model);
    for (const std::string& pass : {direct, indirect, sensors}) {
      if (!pass.empty()) line += ", " + pass;
    }
    if (direct.empty() && indirect.empty() && sensors.empty() && result.direct.bound)
      line += ", before a check confirmed the bounds";
  }
  warn(fmt::format("{}; {}", line, outcome));
}

void warn_of_coarse_triangles(const SimulatedScene& simulated, const std::vector<std::string>& exports) {
  constexpr double coarse = 0.2;
  if (exports.empty()) return;
  const std::vector<double>& errors = simulated.result.triangle_relative_error;
  const auto worst = std::max_element(errors.begin(), errors.end());
  if (worst == errors.end() || !(*worst > coarse)) return;
  const std::string& band = simulated.scene->model.bands[static_cast<std::size_t>(worst - errors.begin())].name;
  warn(fmt::format(
      "--export: {} absorbed by a triangle typically has an error of {:.0f} % (each triangle's own stands beside it); a "
      "smaller --error makes it smaller",
      band, 100.0 * *worst));
}

int report_finished(const std::filesystem::path& folder, const RunOptions& options, std::string_view work) {
  warn_of_missing_pictures(folder, options, work);
  const std::string summary = read_file(folder / summary_file);
  const nlohmann::json finished = nlohmann::json::parse(summary, nullptr, false);
  const bool complete = finished.is_object() && finished.contains("complete") && finished["complete"] == true;
  if (options.json) {
    fmt::print("{}", summary);
  } else {
    say(fmt::format("{}: this {} is finished, nothing to resume", printable(folder.string()), work));
  }
  return complete ? exit_done : exit_short_of_bound;
}

void print_result(const std::filesystem::path& folder, const RunOptions& options, const SimulatedScene& simulated) {
  const RadiationModel& model = simulated.scene->model;
  if (options.json) {
    fmt::print("{}", summary_json(simulated.record, model, simulated.result));
  } else if (!options.quiet) {
    fmt::print("{}{}\n", balance_report(simulated.record, model, simulated.result), folder.string());
  }
}

}  // namespace sunfleck

#include "app/simulation.h"

#include "app/interrupt.h"
#include "app/ranks.h"
#include "base/error.h"
#include "base/log.h"
#include "bvh/bvh.h"
#include "io/exports.h"
#include "io/file.h"
#include "io/judged_figure.h"
#include "light/beam_grid.h"
#include "transport/sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {

SceneTree::SceneTree(const RadiationModel& model)
    : layout(make_counter_layout(model)), bvh(build_bvh(model.canopy, box_padding_m(model))) {
  number_counters(layout, model.canopy, bvh);
}

SolveSettings solve_settings(const RunOptions& options, const Scene& scene) {
  SolveSettings settings;
  settings.accuracy = scene.accuracy;
  settings.accuracy.direct = options.direct_error.value_or(scene.accuracy.direct);
  settings.accuracy.indirect = options.indirect_error.value_or(scene.accuracy.indirect);
  settings.seed = options.seed;
  settings.grid_m = options.grid_m;
  settings.passes = options.passes;
  settings.max_rays = options.max_rays;
  settings.max_seconds = options.max_seconds;
  settings.fit_to_time = !options.resume;
  settings.replicates_at_once = options.threads == 1 ? 1 : 2;
  settings.memory_bytes = static_cast<double>(options.memory_bytes.value_or(available_memory_bytes() / 4));
  // CARIBU's table has no errors.
  const bool shown = std::any_of(options.exports.begin(), options.exports.end(),
                                 [](const std::string& name) { return name != export_name(ExportKind::caribu); });
  const bool of_elements = shown || scene.accuracy.of == ErrorTarget::triangle;
  settings.element_errors = of_elements ? ElementErrors::keep : ElementErrors::skip;
  return settings;
}

void check_grid(const RunOptions& options, const Scene& scene) {
  if (!options.grid_m) return;
  const double replicates = options.passes.value_or(fixed_grid_replicates);
  const double finest_m = std::sqrt(scene.model.plot.area_m2() / (replicates * static_cast<double>(max_grid_rays)));
  if (*options.grid_m >= finest_m) return;
  throw_input(
      fmt::format("--grid {}", *options.grid_m),
      fmt::format("{} replicates on this plot reach {:.2g} m, each of {} rays at most", replicates, finest_m, max_grid_rays),
      "give a wider grid or more --passes");
}

CpuTracer::Scene traced_scene(const RadiationModel& model) {
  return {model.plot.periodic, model.soil.has_value()};
}

RunRecord make_record(const RunOptions& options, const Scene& scene, const SolveSettings& settings, const Engine& engine) {
  RunRecord record;
  record.version = version();
  record.commit = commit();
  record.title = scene.title;
  record.scene_file = scene.file.filename().string();
  record.scene_digest = scene.digest;
  record.seed = settings.seed;
  record.accuracy = settings.accuracy;
  record.grid_m = settings.grid_m;
  record.passes = settings.passes;
  record.max_rays = settings.max_rays;
  record.max_seconds = settings.max_seconds;
  record.memory_bytes = settings.memory_bytes;
  record.threads = options.threads;
  record.device = engine.device();
  return record;
}

std::string device_line(const TracerDevice& device) {
  return fmt::format("device: {}{}", device.name,
                     device.software && device.kind == "vulkan" ? " (software Vulkan, no GPU)" : "");
}

namespace {

// Half-widths at a point come out at about ten times the bound of the totals: a few percent where those have 0.3 %.
std::uint32_t sensor_rays(const SolveSettings& settings) {
  const double bound = settings.grid_m || settings.passes ? 0.01 : settings.accuracy.indirect;
  return static_cast<std::uint32_t>(std::clamp(3.0 / bound, 64.0, 16384.0));
}

}  // namespace

ProgressLine::State progress_state(const Progress& progress) {
  ProgressLine::State state{.rays = progress.rays, .fraction = progress.fraction, .seconds_left = progress.seconds_left};
  if (progress.stage == Progress::Stage::pilot) state.stage = "pilot";
  if (progress.relative_error) {
    state.relative_error = progress.relative_error;
    state.bound = progress.bound;
    state.error_of = progress.pass == Progress::Pass::direct ? "direct" : "indirect";
  }
  return state;
}

RadiationResult simulate(const RadiationModel& model, const CounterLayout& layout, Engine& engine,
                         const SolveSettings& settings, const SimulationAids& aids) {
  ProgressLine progress("simulating");
  Monitor monitor;
  monitor.interrupted = [&aids] { return interrupted() || (aids.ranks != nullptr && aids.ranks->interrupted()); };
  monitor.report = [&](const Progress& state) { progress.update(progress_state(state)); };
  if (aids.keeper != nullptr) aids.keeper->attend(monitor);
  return simulate(model, layout, engine, settings, monitor, aids.ranks != nullptr ? aids.ranks->helpers() : nullptr);
}

RadiationResult simulate(const RadiationModel& model, const CounterLayout& layout, Engine& engine,
                         const SolveSettings& settings, const Monitor& monitor, ReplicateHelpers* helpers) {
  RadiationResult result = solve(model, layout, engine.tracer(), settings, monitor, helpers);
  if (model.sensors.empty() || result.stop == StopReason::interrupted) return result;
  SensorSettings sensors;
  sensors.rays = sensor_rays(settings);
  sensors.seed = settings.seed;
  sensors.confidence = settings.accuracy.confidence;
  if (auto readings = measure_sensors(model, layout, engine.tracer(), sensors, monitor.interrupted)) {
    result.sensors = std::move(*readings);
  } else {
    result.stop = StopReason::interrupted;
  }
  return result;
}

void check_validation(const Engine& engine) {
  const std::vector<std::string> messages = engine.validation_messages();
  if (messages.empty()) return;
  throw_failure(messages.front(), fmt::format("{} messages of the Vulkan validation layer", messages.size()),
                "report it with the scene and the device");
}

bool is_done(StopReason stop) {
  return stop == StopReason::bound_reached || stop == StopReason::work_done;
}

std::string shortfall(const char* pass, const std::optional<double>& error, const std::optional<double>& bound,
                      const std::optional<JudgedFigure>& judged, const RadiationModel& model) {
  if (!error || !bound || !judged || *error <= *bound) return "";
  return fmt::format("{} error {:.2g} of {:.2g} ({})", pass, *error, *bound, figure_name(*judged, model));
}

void warn_if_short(const SolveSettings& settings, const RadiationModel& model, const RadiationResult& result,
                   std::string_view cure) {
  if (is_done(result.stop)) return;
  std::string line = "interrupted";
  if (result.stop == StopReason::time_spent)
    line = fmt::format("stopped after --max-seconds {}", settings.max_seconds.value_or(0));
  if (result.stop == StopReason::replicates_spent) line = "stopped at the most replicates of a run";
  if (result.stop == StopReason::rays_spent) line = fmt::format("stopped at --max-rays {}", settings.max_rays.value_or(0));
  if (result.direct.rays + result.indirect.sky_rays + result.indirect.packets == 0) {
    line += " before the first rays were counted: the tables hold no light yet";
  } else {
    line += fmt::format(" after {} replicates", result.direct.replicates);
    const std::string direct =
        shortfall("direct", result.direct.relative_error, result.direct.bound, result.direct.judged, model);
    const std::string indirect =
        shortfall("indirect", result.indirect.relative_error, result.indirect.bound, result.indirect.judged, model);
    for (const std::string& pass : {direct, indirect}) {
      if (!pass.empty()) line += ", " + pass;
    }
    if (direct.empty() && indirect.empty() && result.direct.bound) line += ", before a second check confirmed the bounds";
  }
  warn(fmt::format("{}; the results are kept, marked incomplete{}", line, cure));
}

int exit_status(StopReason stop) {
  if (is_done(stop)) return exit_done;
  return stop == StopReason::interrupted ? exit_interrupted : exit_short_of_bound;
}

}  // namespace sunfleck

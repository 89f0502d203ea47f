#include "app/commands.h"

#include "app/engine.h"
#include "app/interrupt.h"
#include "app/pictures.h"
#include "app/report.h"
#include "base/error.h"
#include "base/log.h"
#include "bvh/bvh.h"
#include "canopy/maize.h"
#include "io/file.h"
#include "io/image_writer.h"
#include "io/mesh_writer.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "light/beam_grid.h"
#include "transport/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace sunfleck {
namespace {

constexpr int exit_done = 0;
constexpr int exit_short_of_bound = 1;
constexpr int exit_interrupted = 130;

constexpr const char* summary_file = "summary.json";
constexpr const char* profile_file = "profile.csv";
constexpr const char* organs_file = "organs.csv";
constexpr const char* triangles_file = "triangles.csv";

// The pictures of a run, by the stem of their file.
struct Picture {
  const char* stem;
  LightField field;
};
constexpr Picture pictures[] = {
    {"rank_direct", LightField::direct}, {"rank_indirect", LightField::indirect}, {"rank_total", LightField::total}};

std::string file_of(const Picture& picture) {
  return std::string(picture.stem) + ".png";
}

// Of --grid without --passes.
constexpr int fixed_grid_replicates = 16;

// Seconds since the last question.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::filesystem::path result_folder(const RunOptions& options) {
  return options.output.empty() ? std::filesystem::path("results") / options.scene.stem() : options.output;
}

// What only the scene can tell of the options.
void check_against_scene(const RunOptions& options, const Scene& scene) {
  static_cast<void>(picture_band(scene.model, options.band));
  if (!options.grid_m) return;
  const double replicates = options.passes.value_or(fixed_grid_replicates);
  const double finest_m = std::sqrt(scene.model.plot.area_m2() / (replicates * static_cast<double>(max_grid_rays)));
  if (*options.grid_m >= finest_m) return;
  throw_input(
      fmt::format("--grid {}", *options.grid_m),
      fmt::format("{} replicates on this plot reach {:.2g} m, each of {} rays at most", replicates, finest_m, max_grid_rays),
      "give a wider grid or more --passes");
}

// Made, and tried, before rays are traced: nothing of that shall be lost for want of a folder. What an earlier run left goes,
// so that the folder never holds pieces of two.
void prepare_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto refuse = [&](const std::filesystem::path& path) {
    throw_failure(printable(path.string()), error.message(), "give a folder that can be written with -o");
  };
  if (error) refuse(folder);
  const bool of_earlier_run = std::filesystem::exists(folder / summary_file, error);
  write_file(folder / summary_file, "{\"complete\": false}\n");
  if (!of_earlier_run) return;
  std::vector<std::string> names{profile_file, organs_file, triangles_file};
  for (const Picture& picture : pictures) names.push_back(file_of(picture));
  for (const std::string& name : names) {
    std::filesystem::remove(folder / name, error);
    if (error) refuse(folder / name);
  }
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
  settings.element_errors = !options.exports.empty() || scene.accuracy.of == ErrorTarget::triangle;
  return settings;
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
  record.threads = options.threads;
  record.device = engine.device();
  return record;
}

RadiationResult simulate(const RadiationModel& model, const CounterLayout& layout, Engine& engine,
                         const SolveSettings& settings) {
  ProgressLine progress("simulating");
  Monitor monitor;
  monitor.interrupted = interrupted;
  monitor.report = [&](const Progress& state) {
    progress.update({state.rays, state.fraction, state.relative_error, state.bound});
  };
  return solve(model, layout, engine.tracer(), settings, monitor);
}

void write_tables(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
                  const RadiationModel& model, const RadiationResult& result) {
  write_file(folder / profile_file, profile_csv(record, model, result));
  write_file(folder / organs_file, organs_csv(record, model, result));
  const bool triangles = std::find(options.exports.begin(), options.exports.end(), "csv") != options.exports.end();
  if (triangles) write_file(folder / triangles_file, triangles_csv(record, model, result));
}

// Those asked for that have something to show: none of a light that the scene does not have.
std::vector<Picture> wanted_pictures(const RunOptions& options, const RadiationModel& model, const RadiationResult& result) {
  const bool indirect = result.indirect.packets > 0;
  std::vector<Picture> wanted;
  for (const Picture& picture : pictures) {
    const bool asked = std::any_of(options.images.begin(), options.images.end(),
                                   [&](const std::string& name) { return name == "all" || name == picture.stem; });
    const bool there = picture.field == LightField::direct ? model.has_beam() : indirect;
    if (asked && there) wanted.push_back(picture);
  }
  return wanted;
}

// False if interrupted before all were drawn.
bool write_pictures(const std::filesystem::path& folder, const RunOptions& options, const Scene& scene,
                    const CounterLayout& layout, const RadiationResult& result, const Engine& engine) {
  const std::vector<Picture> wanted = wanted_pictures(options, scene.model, result);
  if (wanted.empty()) return true;
  RankCharts charts(scene, layout, result, options);
  if (!charts.look(engine, interrupted)) return false;
  for (const Picture& picture : wanted) {
    if (interrupted()) return false;
    write_png(charts.draw(picture.field), folder / file_of(picture));
  }
  return true;
}

// A message of the validation layer is our own mistake, and nothing that was computed can be trusted.
void check_validation(const Engine& engine) {
  const std::vector<std::string> messages = engine.validation_messages();
  if (messages.empty()) return;
  throw_failure(messages.front(), fmt::format("{} messages of the Vulkan validation layer", messages.size()),
                "report it with the scene and the device");
}

bool is_done(StopReason stop) {
  return stop == StopReason::bound_reached || stop == StopReason::work_done;
}

// One line about a run that ended early; none about others.
void warn_if_short(const SolveSettings& settings, const RadiationResult& result) {
  if (is_done(result.stop)) return;
  std::string line = "interrupted";
  if (result.stop == StopReason::time_spent)
    line = fmt::format("stopped after --max-seconds {}", settings.max_seconds.value_or(0));
  if (result.stop == StopReason::rays_spent) line = fmt::format("stopped at --max-rays {}", settings.max_rays.value_or(0));
  if (result.direct.rays == 0) {
    line += " before the first rays were counted: the tables hold no light yet";
  } else {
    line += fmt::format(" after {} replicates", result.direct.replicates);
    if (result.direct.relative_error) line += fmt::format(", relative error {:.2g}", *result.direct.relative_error);
    if (result.direct.bound) line += fmt::format(" of {:.2g}", *result.direct.bound);
  }
  warn(line + "; the results are kept, marked incomplete");
}

int exit_status(StopReason stop) {
  if (is_done(stop)) return exit_done;
  return stop == StopReason::interrupted ? exit_interrupted : exit_short_of_bound;
}

// The summary into its file, and to the user what was asked for.
void publish(const std::filesystem::path& folder, const RunOptions& options, const RunRecord& record,
             const RadiationModel& model, const RadiationResult& result) {
  const std::string summary = summary_json(record, model, result);
  write_file(folder / summary_file, summary);
  if (options.json) {
    fmt::print("{}", summary);
  } else if (!options.quiet) {
    fmt::print("{}{}\n", balance_report(record, model, result), folder.string());
  }
}

}  // namespace

int run(const RunOptions& options) {
  start_log(options.quiet || options.json ? Verbosity::quiet : Verbosity::normal);
  watch_for_interrupts();
  Stopwatch total;
  Stopwatch watch;
  const std::filesystem::path folder = result_folder(options);

  const Scene scene = read_scene(options.scene, {options.allow_outside});
  for (const std::string& warning : scene.warnings) warn(warning);
  const RadiationModel& model = scene.model;
  const SolveSettings settings = solve_settings(options, scene);
  check_against_scene(options, scene);
  RunRecord::Seconds seconds;
  seconds.load = watch.lap();

  const CounterLayout layout = make_counter_layout(model);
  Bvh bvh = build_bvh(model.canopy, box_padding_m(model));
  number_counters(layout, model.canopy, bvh);
  seconds.bvh = watch.lap();

  set_software_threads(options.threads);
  const CpuThreads threads(options.threads);
  Engine engine(options.device, bvh, {model.plot.periodic, model.soil.has_value()}, layout.words());
  RunRecord record = make_record(options, scene, settings, engine);
  prepare_folder(folder);
  say(fmt::format("device: {}{}", record.device.name,
                  record.device.software && record.device.kind == "vulkan" ? " (software Vulkan, no GPU)" : ""));
  seconds.device = watch.lap();

  RadiationResult result = simulate(model, layout, engine, settings);
  check_validation(engine);
  seconds.direct = result.direct.seconds;
  seconds.indirect = result.indirect.seconds;
  watch.lap();

  write_tables(folder, options, record, model, result);
  if (!write_pictures(folder, options, scene, layout, result, engine)) result.stop = StopReason::interrupted;
  check_validation(engine);
  warn_if_short(settings, result);
  record.complete = is_done(result.stop);
  seconds.write = watch.lap();
  seconds.total = total.lap();
  record.seconds = seconds;
  publish(folder, options, record, model, result);
  return exit_status(result.stop);
}

int write_maize(const MaizeOptions& options) {
  start_log(Verbosity::normal);
  const Mesh mesh = make_maize({options.rows, options.per_row, options.spacing_m[0], options.spacing_m[1], options.seed});
  write_gltf(mesh, options.output);
  fmt::print("{}: {} triangles, {} organs\n", options.output.string(), mesh.triangles.size(), mesh.organs.size());
  return exit_done;
}

}  // namespace sunfleck

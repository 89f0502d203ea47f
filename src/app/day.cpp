#include "app/day.h"

#include "app/day_plan.h"
#include "app/day_steps.h"
#include "app/interrupt.h"
#include "app/ranks.h"
#include "app/result_folder.h"
#include "app/scene_source.h"
#include "app/simulation.h"
#include "base/error.h"
#include "base/log.h"
#include "io/day_netcdf.h"
#include "io/day_plot.h"
#include "io/day_summary.h"
#include "io/day_tables.h"
#include "io/file.h"
#include "io/gnuplot.h"
#include "io/step_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* summary_file = "summary.json";
constexpr const char* day_file = "day.csv";
constexpr const char* organs_file = "organs_day.csv";
constexpr const char* fields_file = "day.nc";
constexpr const char* plot_file = "day.png";
constexpr const char* resume_hint = ", then go on with --resume";

// The day's limit of time ends it between rays like Ctrl-C, not by smaller replicates: the bytes do not depend on the clock.
class DayClock {
 public:
  DayClock(std::optional<double> max_seconds, const Ranks& ranks) : ranks_(ranks), max_seconds_(max_seconds) {}
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] bool interrupted() const { return sunfleck::interrupted() || ranks_.interrupted(); }
  [[nodiscard]] bool stop() const { return interrupted() || (max_seconds_ && seconds() >= *max_seconds_); }

 private:
  const Ranks& ranks_;
  std::optional<double> max_seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What the steps found, in their order; fewer than the plan has where the day was stopped.
struct DayResult {
  std::vector<StepLight> lights;
  DayTotals totals;
};

class DayRun {
 public:
  DayRun(Scene& scene, const DayPlan& plan, const SolveSettings& settings, const SceneTree& tree, Engine& engine, Ranks& ranks,
         const StepStore& store, const DayClock& clock)
      : model_(scene.model),
        plan_(plan),
        ranks_(ranks),
        store_(store),
        clock_(clock),
        steps_(model_, plan, settings, tree.layout, engine, ranks.helpers()) {
    const auto& steps = plan.course.steps;
    lit_steps_ = static_cast<double>(std::count_if(steps.begin(), steps.end(), [](const DayStep& s) { return !s.night(); }));
  }

  DayResult run() {
    for (std::size_t i = 0; i < plan_.course.steps.size(); ++i) {
      if (clock_.stop()) break;
      if (plan_.course.steps[i].night()) {
        result_.lights.push_back(night_light(model_));
        continue;
      }
      std::optional<StoredStep> step = store_.read(i);
      if (!step) {
        step = simulate_step(i);
        if (!step) break;
        wait_for_step_before();
        writing_ = store_.begin_write(i, *step);
        tell(i, *step);
      }
      steps_.count(*step);
      result_.lights.push_back(std::move(step->light));
    }
    wait_for_step_before();
    result_.totals = steps_.totals();
    return std::move(result_);
  }

 private:
  // A step is brought to the disk while the next one is simulated.
  void wait_for_step_before() {
    if (writing_.valid()) writing_.get();
  }

  std::optional<StoredStep> simulate_step(std::size_t i) {
    ranks_.set_stage(i);
    const DayTotals& totals = steps_.totals();
    const auto report = [&](const Progress& state) {
      const double done = static_cast<double>(totals.simulated) + state.fraction;
      ProgressLine::State shown = progress_state(state);
      shown.rays = totals.rays + totals.packets + state.rays;
      shown.fraction = done / lit_steps_;
      shown.seconds_left.reset();
      if (totals.simulated > 0) shown.stage = "";
      progress_.update(shown);
    };
    return steps_.simulate(
        i, [this] { return clock_.stop(); }, report);
  }

  void tell(std::size_t i, const StoredStep& step) const {
    constexpr double degree = std::numbers::pi / 180.0;
    const DayStep& when = plan_.course.steps[i];
    std::string line = fmt::format("step {} of {}: {}, sun {:.1f} deg, {:.2f} s", i + 1, plan_.course.steps.size(),
                                   local_time_text(when.start, plan_.course.offset_minutes).substr(0, 16),
                                   when.sun.elevation_rad / degree, step.seconds);
    if (step.direct_error) line += fmt::format(", error {:.2g} direct", *step.direct_error);
    if (step.indirect_error) line += fmt::format(", {:.2g} indirect", *step.indirect_error);
    say(step.reached_bound ? line : line + ", stopped at --max-rays short of the bound");
  }

  RadiationModel& model_;
  const DayPlan& plan_;
  Ranks& ranks_;
  const StepStore& store_;
  const DayClock& clock_;
  DaySteps steps_;
  double lit_steps_ = 0.0;
  DayResult result_;
  std::future<void> writing_;  // of the last step
  ProgressLine progress_{"day"};
};

void draw_day(const fs::path& folder, const RunRecord& record, const RadiationModel& model, const DayCourse& course,
              const DayResult& day, std::size_t band) {
  DayPlot plot;
  plot.title = record.title;
  plot.band = model.bands[band].name;
  plot.confidence = record.accuracy.confidence;
  for (std::size_t i = 0; i < day.lights.size(); ++i) {
    const DayStep& step = course.steps[i];
    const StepBand& light = day.lights[i].bands[band];
    DayPlotRow row;
    row.start_s = local_clock_s(local_time_text(step.start, course.offset_minutes)).value();
    row.step_s = step.length_s;
    row.incident = light.incident;
    row.absorbed_vegetation = light.absorbed_vegetation;
    row.absorbed_soil = light.absorbed_soil;
    row.reflected = light.reflected;
    row.sunlit_leaf_fraction =
        step.night() ? Estimate{std::numeric_limits<double>::quiet_NaN()} : day.lights[i].sunlit_leaf_fraction;
    plot.rows.push_back(row);
  }
  if (const std::optional<std::string> problem = draw_plot(day_plot(plot), folder / plot_file)) warn(*problem);
}

void write_fields(const fs::path& folder, const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                  const DayResult& day, const StepStore& store) {
  const auto fields = [&store](std::size_t step) {
    std::optional<StoredStep> stored = store.read(step);
    if (!stored) throw_failure(fmt::format("step {}", step + 1), "its file is gone or damaged", "run again with --resume");
    return std::move(stored->fields);
  };
  write_day_netcdf(folder / fields_file, store.scratch_file(), {record, model, course, day.lights.size(), fields});
  std::error_code error;
  const double megabytes = static_cast<double>(fs::file_size(folder / fields_file, error)) * 1e-6;
  say(fmt::format("{}: {:.1f} MB", fields_file, megabytes));
}

void write_results(const fs::path& folder, const DayOptions& options, const RunRecord& record, const RadiationModel& model,
                   const DayCourse& course, const DayResult& day, const StepStore& store, Losses& losses) {
  losses.attempt(day_file, [&] { write_file(folder / day_file, day_csv(record, model, course, day.lights)); });
  losses.attempt(organs_file, [&] { write_file(folder / organs_file, organs_day_csv(record, model, course, day.lights)); });
  if (day.lights.empty()) return;
  losses.attempt(fields_file, [&] { write_fields(folder, record, model, course, day, store); });
  const bool none = std::find(options.run.images.begin(), options.run.images.end(), "none") != options.run.images.end();
  if (none) return;
  losses.attempt(plot_file,
                 [&] { draw_day(folder, record, model, course, day, picture_band(model, options.run.pictures.band)); });
}

// What stops a day in its middle leaves the finished steps where they are.
DayResult run_steps(DayRun day) {
  try {
    return day.run();
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) + resume_hint);
  }
}

int warn_if_stopped(const DayCourse& course, const DayResult& day, const RunOptions& options, bool interrupted) {
  if (day.lights.size() < course.steps.size()) {
    const std::string why = interrupted ? "interrupted" : fmt::format("stopped after --max-seconds {}", *options.max_seconds);
    warn(fmt::format("{} after {} of {} steps; they are kept, and --resume goes on", why, day.lights.size(),
                     course.steps.size()));
    return interrupted ? exit_interrupted : exit_short_of_bound;
  }
  if (day.totals.short_of_bound == 0) return exit_done;
  warn(fmt::format("{} of {} steps stopped at --max-rays {} short of their bound; the results are marked incomplete",
                   day.totals.short_of_bound, course.steps.size(), options.max_rays.value_or(0)));
  return exit_short_of_bound;
}

Scene read_day_scene(const RunOptions& options) {
  Scene scene = load_scene(options.scene, options.stand, {options.allow_outside, ScenePurpose::day});
  for (const std::string& warning : scene.warnings) warn(warning);
  if (!scene.model.planes.empty() || !scene.model.sensors.empty()) say("planes and sensors are left to `run`");
  scene.model.planes.clear();
  scene.model.sensors.clear();
  return scene;
}

int help_with_day(const DayOptions& options, Ranks& ranks) {
  return ranks.help([&](const auto& serve) {
    Scene scene = read_day_scene(options.run);
    const DayPlan plan = plan_day(options, scene);
    const SceneTree tree(scene.model);
    set_software_threads(options.run.threads);
    const CpuThreads threads(options.run.threads);
    Engine engine({options.run.device, options.run.device_turn}, tree.bvh, traced_scene(scene.model), tree.layout.words());
    const SolveSettings settings = solve_settings(options.run, scene);
    serve({scene, tree.layout, engine, settings, [&](std::uint64_t step) { set_light(scene.model, plan.lights.at(step)); }});
  });
}

}  // namespace

int run_day(const DayOptions& asked) {
  start_log(asked.run.quiet || asked.run.json ? Verbosity::quiet : Verbosity::normal);
  exit_on_interrupts();
  Stopwatch total;
  Stopwatch watch;
  Ranks ranks;
  DayOptions options = asked;
  options.run = ranks.own_options(asked.run);
  if (ranks.helps()) return help_with_day(options, ranks);
  const fs::path folder = result_folder(options.run);
  FolderLock lock(folder);

  Scene scene = read_day_scene(options.run);
  const DayPlan plan = plan_day(options, scene);
  SolveSettings settings = solve_settings(options.run, scene);
  settings.element_errors = ElementErrors::keep;
  settings.max_seconds.reset();
  check_grid(options.run, scene);
  static_cast<void>(picture_band(scene.model, options.run.pictures.band));
  const ordered_json kept_settings = day_settings(options, scene, settings, plan);
  StepStore store(folder, scene.model, kept_settings);
  const StepStore::Found found = options.run.resume ? store.find() : StepStore::Found::nothing;
  if (found == StepStore::Found::finished) return tell_finished(folder, options.run, "day");
  RunRecord::Seconds seconds;
  seconds.load = watch.lap();

  const SceneTree tree(scene.model);
  seconds.bvh = watch.lap();
  set_software_threads(options.run.threads);
  const CpuThreads threads(options.run.threads);
  const RadiationModel& model = scene.model;
  Engine engine({options.run.device, options.run.device_turn}, tree.bvh, traced_scene(model), tree.layout.words());
  RunRecord record = make_record(options.run, scene, settings, engine);
  record.max_seconds = options.run.max_seconds;
  record.ranks = ranks.count();
  ranks.gather(scene, tree.layout, settings);
  watch_for_interrupts();
  if (found == StepStore::Found::begun) {
    reopen_folder(folder);
  } else {
    prepare_folder(folder, lock);
    store.begin();
  }
  say(device_line(record.device));
  seconds.device = watch.lap();

  const DayClock clock(options.run.max_seconds, ranks);
  const DayResult day = run_steps(DayRun(scene, plan, settings, tree, engine, ranks, store, clock));
  ranks.release();
  watch.lap();

  const int status = warn_if_stopped(plan.course, day, options.run, clock.interrupted());
  record.complete = status == exit_done;
  Losses losses;
  write_results(folder, options, record, model, plan.course, day, store, losses);
  record.not_written = losses.names();
  record.complete = record.complete && record.not_written.empty();
  seconds.write = watch.lap();
  seconds.total = total.lap();
  record.seconds = seconds;
  const DaySummary summary{record, model, plan.course, day.lights, day.totals, kept_settings};
  const std::string summary_text = day_summary_json(summary);
  losses.attempt(summary_file, [&] {
    write_file(folder / summary_file, summary_text);
    if (losses.names().empty() && day.lights.size() == plan.course.steps.size()) store.finish();
  });
  if (options.run.json) {
    fmt::print("{}", summary_text);
  } else if (!options.run.quiet) {
    fmt::print("{}{}\n", day_report(summary), folder.string());
  }
  losses.complain(resume_hint);
  return status;
}

}  // namespace sunfleck

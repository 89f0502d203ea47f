#include "programs/cli/day.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "base/units.h"
#include "files/results/exports/day_netcdf.h"
#include "files/results/plots/plots.h"
#include "files/results/stores/step_store.h"
#include "files/results/tables/day_summary.h"
#include "files/results/tables/day_tables.h"
#include "programs/cli/process.h"
#include "programs/cli/terminal.h"
#include "simulate/day.h"
#include "simulate/day_blocks.h"
#include "simulate/interrupt.h"
#include "simulate/ranks.h"
#include "simulate/result_folder.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* day_file = "day.csv";
constexpr const char* sums_file = "day_sums.csv";
constexpr const char* organs_file = "organs_day.csv";
constexpr const char* plants_file = "plants_day.csv";
constexpr const char* fields_file = "day.nc";
constexpr const char* plot_file = "day.png";
constexpr const char* resume_hint = ", then continue with --resume";

// Stores the steps in the folder: a step is written to the disk while the next one is simulated.
class FolderSink final : public DaySink {
 public:
  FolderSink(const StepStore& store, const DayCourse& course) : store_(store), course_(course) {}

  [[nodiscard]] std::optional<StoredStep> find(std::size_t step) override { return store_.read(step); }
  void take(std::size_t step, StoredStep& simulated) override {
    wait();
    writing_ = store_.begin_write(step, simulated);
    report(step, simulated);
  }
  // Waits until all steps are on the disk.
  void wait() {
    if (writing_.valid()) writing_.get();
  }

 private:
  void report(std::size_t i, const StoredStep& step) const {
    const DayStep& when = course_.steps[i];
    std::string line = fmt::format("step {} of {}: {}, sun {:.1f} deg, {:.2f} s", i + 1, course_.steps.size(),
                                   local_time_text(when.start, course_.offset_minutes).substr(0, 16),
                                   when.sun.elevation_rad / degree, step.seconds);
    if (step.direct_error) line += fmt::format(", error {:.2g} direct", *step.direct_error);
    if (step.indirect_error) line += fmt::format(", {:.2g} indirect", *step.indirect_error);
    say(step.reached_bound ? line : line + ", stopped at --max-rays short of the bound");
  }

  const StepStore& store_;
  const DayCourse& course_;
  std::future<void> writing_;  // writes the last step
};

void draw_day(const fs::path& folder, const std::string& title, const std::string& band) {
  PlotVariables variables;
  variables.set_file("table", folder / day_file);
  variables.set_file("sums", folder / sums_file);
  variables.set_text("title", title);
  variables.set_text("band", band);
  if (const std::optional<std::string> problem = draw_table("day.gp", variables, folder / plot_file)) warn(*problem);
}

void write_fields(const fs::path& folder, const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                  const SimulatedDay& day, const StepStore& store) {
  const auto fields = [&store](std::size_t step) {
    std::optional<StoredStep> stored = store.read(step);
    if (!stored) throw_failure(fmt::format("step {}", step + 1), "its file is missing or damaged", "run again with --resume");
    return std::move(stored->fields);
  };
  write_day_netcdf(folder / fields_file, store.scratch_file(), {record, model, course, day.lights.size(), fields});
  std::error_code error;
  const double megabytes = static_cast<double>(fs::file_size(folder / fields_file, error)) * 1e-6;
  say(fmt::format("{}: {:.1f} MB", fields_file, megabytes));
}

// A day and the folder for its results.
struct DayJob {
  const DayOptions& options;
  const fs::path& folder;
  const DayPlan& plan;
  StepStore& store;
  // Returns everything on which the bytes depend.
  const ordered_json& settings;
};

UnwrittenFiles write_tables(const DayJob& job, const RunRecord& record, const RadiationModel& model, const SimulatedDay& day) {
  const DayCourse& course = job.plan.course;
  UnwrittenFiles unwritten;
  unwritten.attempt(day_file, [&] { write_file(job.folder / day_file, day_csv(record, model, course, day.lights)); });
  unwritten.attempt(sums_file, [&] { write_file(job.folder / sums_file, day_sums_csv(record, model, course, day.lights)); });
  unwritten.attempt(organs_file,
                    [&] { write_file(job.folder / organs_file, organs_day_csv(record, model, course, day.lights)); });
  unwritten.attempt(plants_file,
                    [&] { write_file(job.folder / plants_file, plants_day_csv(record, model, course, day.lights)); });
  if (day.lights.empty()) return unwritten;
  unwritten.attempt(fields_file, [&] { write_fields(job.folder, record, model, course, day, job.store); });
  const std::vector<std::string>& images = job.options.run.images;
  if (std::find(images.begin(), images.end(), "none") != images.end()) return unwritten;
  const std::size_t band = picture_band(model, job.options.run.pictures.band);
  unwritten.attempt(plot_file, [&] { draw_day(job.folder, record.title, model.bands[band].name); });
  return unwritten;
}

// Writes tables, fields, plot and summary, and prints the summary or a report.
void write_day(const DayJob& job, RunRecord record, const RadiationModel& model, const SimulatedDay& day) {
  Stopwatch watch;
  const RunOptions& run = job.options.run;
  UnwrittenFiles unwritten = write_tables(job, record, model, day);
  record.not_written = unwritten.names();
  record.complete = record.complete && record.not_written.empty();
  record.seconds.write = watch.lap();
  record.seconds.total += record.seconds.write;
  const DaySummary summary{record, model, job.plan.course, day.lights, day.totals, job.settings};
  const std::string text = day_summary_json(summary);
  unwritten.attempt(summary_file, [&] {
    write_file(job.folder / summary_file, text);
    if (unwritten.names().empty() && day.lights.size() == job.plan.course.steps.size()) job.store.finish();
  });
  if (run.json) {
    fmt::print("{}", text);
  } else if (!run.quiet) {
    fmt::print("{}{}\n", day_report(summary), job.folder.string());
  }
  unwritten.throw_if_any(resume_hint);
}

// Simulates the steps until they are done, --max-seconds have passed or Ctrl-C stops them; an error leaves the finished steps
// in place.
SimulatedDay run_steps(Simulation& simulation, const DayJob& job, const SolveSettings& settings, Ranks& ranks) {
  ProgressLine line("day");
  RunHooks hooks{terminal_monitor(line), nullptr, &ranks};
  const Stopwatch clock;
  const std::optional<double>& max_seconds = job.options.run.max_seconds;
  hooks.monitor.interrupted = [&] { return interrupted() || (max_seconds && clock.seconds() >= *max_seconds); };
  FolderSink sink(job.store, job.plan.course);
  try {
    SimulatedDay day = simulate_day(simulation, job.plan, settings, sink, hooks);
    sink.wait();
    return day;
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) + resume_hint);
  }
}

int warn_if_stopped(const DayCourse& course, const SimulatedDay& day, const RunOptions& options, bool interrupted) {
  if (day.lights.size() < course.steps.size()) {
    const std::string why = interrupted ? "interrupted" : fmt::format("stopped after --max-seconds {}", *options.max_seconds);
    warn(fmt::format("{} after {} of {} steps; they are kept, and --resume continues the day", why, day.lights.size(),
                     course.steps.size()));
    return interrupted ? exit_interrupted : exit_short_of_bound;
  }
  if (day.totals.short_of_bound == 0) return exit_done;
  warn(fmt::format("{} of {} steps stopped at --max-rays {} short of their bound; the results are marked incomplete",
                   day.totals.short_of_bound, course.steps.size(), options.max_rays.value_or(0)));
  return exit_short_of_bound;
}

Scene read_day_scene(const RunOptions& options) {
  Scene scene = load_scene_with_warnings(options, ScenePurpose::day);
  if (remove_receivers(scene)) say("planes and sensors are ignored; only `run` computes them");
  return scene;
}

// Does the part of a rank other than 0 in a day.
int help_with_day(const DayOptions& options, Ranks& ranks) {
  const bool served = ranks.serve([&](const auto& make_replicates) {
    Scene scene = read_day_scene(options.run);
    const SolveSettings settings = day_solve_settings(options.run, scene, options.run.threads);
    const DayPlan plan = plan_day_in_blocks(options, options.run, scene, settings);
    Simulation simulation(std::move(scene), options.run);
    make_replicates({simulation, settings,
                     [&](std::uint64_t block) { return lights_of(simulation.model(), plan, plan.blocks.at(block)); }});
  });
  return served ? exit_done : exit_failed;
}

// Prepares the folder for the steps that are still to be simulated.
void open_day_folder(const fs::path& folder, FolderLock& lock, StepStore& store, bool resumed) {
  if (resumed) {
    reopen_folder(folder);
  } else {
    prepare_folder(folder, lock);
    store.begin();
  }
}

}  // namespace

int run_day(const DayOptions& asked) {
  start_at_terminal(asked.run);
  keep_freed_memory();
  Stopwatch watch;
  Ranks ranks;
  DayOptions options = asked;
  const RunOptions& run = options.run;
  ranks.take_seat(options.run);
  if (ranks.is_worker()) return help_with_day(options, ranks);
  const fs::path folder = result_folder(run, run.scene);
  FolderLock lock(folder);

  Scene scene = read_day_scene(run);
  const SolveSettings settings = day_solve_settings(run, scene, run.threads);
  const DayPlan plan = plan_day_in_blocks(options, run, scene, settings);
  check_inputs(folder, scene);
  check_grid(run, scene);
  static_cast<void>(picture_band(scene.model, run.pictures.band));
  const ordered_json kept_settings = day_settings(options, scene, settings, plan);
  StepStore store(folder, scene.model, kept_settings);
  const StepStore::Found found = run.resume ? store.find() : StepStore::Found::nothing;
  if (found == StepStore::Found::finished) return report_finished(folder, run, "day");
  const double load_s = watch.lap();

  Simulation simulation(std::move(scene), run);
  ranks.gather(simulation, settings);
  watch_for_interrupts();
  open_day_folder(folder, lock, store, found == StepStore::Found::begun);
  say(device_line(simulation.device()));

  const DayJob job{options, folder, plan, store, kept_settings};
  const SimulatedDay day = run_steps(simulation, job, settings, ranks);
  ranks.release();

  const int status = warn_if_stopped(plan.course, day, run, interrupted() || ranks.interrupted());
  RunRecord record = simulation.record(settings);
  record.max_seconds = run.max_seconds;
  record.ranks = ranks.count();
  record.complete = status == exit_done;
  record.seconds.load = load_s;
  record.seconds.total = watch.seconds() + load_s;
  write_day(job, record, simulation.model(), day);
  return status;
}

}  // namespace sunfleck

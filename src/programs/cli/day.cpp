#include "programs/cli/day.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "base/units.h"
#include "files/results/stores/step_store.h"
#include "files/results/tables/day_summary.h"
#include "files/results/tables/plane_day.h"
#include "programs/cli/process.h"
#include "programs/cli/terminal.h"
#include "simulate/day.h"
#include "simulate/day_blocks.h"
#include "simulate/day_folder.h"
#include "simulate/interrupt.h"
#include "simulate/ranks.h"
#include "simulate/result_folder.h"
#include "simulate/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* resume_hint = ", then continue with --resume";

// Stores the steps in the folder: a step is written to the disk while the next one is simulated. Reports each step or, of several
// dates, each date.
class FolderSink final : public DaySink {
 public:
  FolderSink(const StepStore& store, const DayCourse& course, StepFields fields)
      : store_(store), course_(course), fields_(fields) {}

  [[nodiscard]] std::optional<StoredStep> find(std::size_t step) override { return store_.read(step); }
  [[nodiscard]] StepFields fields() const override { return fields_; }
  [[nodiscard]] std::optional<RunStore> block_store(const ordered_json& settings) override {
    return store_.block_store(settings);
  }
  void take(std::size_t step, StoredStep& simulated) override {
    wait();
    writing_ = store_.begin_write(step, simulated);
    if (course_.dates.size() > 1) {
      report_date(step, simulated);
    } else {
      report_step(step, simulated);
    }
  }
  // Waits until all steps are on the disk.
  void wait() {
    if (writing_.valid()) writing_.get();
  }

 private:
  static std::string errors_text(const StoredStep& step) {
    std::string text;
    if (step.direct_error) text += fmt::format(", error {:.2g} direct", *step.direct_error);
    if (step.indirect_error) text += fmt::format(", {:.2g} indirect", *step.indirect_error);
    return text;
  }
  void report_step(std::size_t i, const StoredStep& step) const {
    const DayStep& when = course_.steps[i];
    const std::string line = fmt::format("step {} of {}: {}, sun {:.1f} deg, {:.2f} s", i + 1, course_.steps.size(),
                                         local_time_text(when.start, course_.offset_minutes).substr(0, 16),
                                         when.sun.elevation_rad / degree, step.seconds) +
                             errors_text(step);
    say(step.reached_bound ? line : line + ", stopped at --max-rays short of the bound");
  }
  // Reports a date after its last daytime step.
  void report_date(std::size_t i, const StoredStep& step) {
    ++steps_;
    seconds_ += step.seconds;
    const std::size_t date = course_.steps[i].date;
    std::size_t next = i + 1;
    while (next < course_.steps.size() && course_.steps[next].unlit()) ++next;
    if (next < course_.steps.size() && course_.steps[next].date == date) return;
    say(fmt::format("date {} of {}: {}, {} steps simulated, {:.2f} s", date + 1, course_.dates.size(), course_.dates[date],
                    std::exchange(steps_, 0), std::exchange(seconds_, 0.0)));
  }

  const StepStore& store_;
  const DayCourse& course_;
  StepFields fields_;
  std::future<void> writing_;  // writes the last step
  // The steps of a date that were simulated so far, and the time they took.
  std::size_t steps_ = 0;
  double seconds_ = 0.0;
};

// Throws Error (input) if the maps of planes are requested that the folder of a finished day lacks.
void expect_plane_maps(const fs::path& folder, const RunOptions& run, const RadiationModel& model) {
  if (std::find(run.exports.begin(), run.exports.end(), "nc") == run.exports.end()) return;
  for (const PlaneReceiver& plane : model.planes) {
    if (const auto lack = lack_of(folder, "day", plane_day_stem(plane) + ".nc"))
      throw_input("--export nc", *lack, cure_of_lack);
  }
}

// A day and the folder for its results.
struct DayJob {
  const DayOptions& options;
  const fs::path& folder;
  const DayPlan& plan;
  StepStore& store;
  const ordered_json& settings;  // everything on which the bytes depend
};

// Writes all files, the summary last, and prints the summary or a report.
void write_day(const DayJob& job, RunRecord record, const RadiationModel& model, const SimulatedDay& day) {
  Stopwatch watch;
  const RunOptions& run = job.options.run;
  WrittenDay written = write_day_files(job.folder, run, {record, model, job.plan.course, job.store, day.steps});
  record.not_written = written.unwritten.names();
  record.complete = record.complete && record.not_written.empty();
  record.seconds.write = watch.lap();
  record.seconds.total += record.seconds.write;
  const DaySummary summary{record, model, job.plan.course, day.steps, written.sums, day.totals, job.settings};
  const std::string text = day_summary_json(summary);
  written.unwritten.attempt(summary_file, [&] {
    write_file(job.folder / summary_file, text);
    if (written.unwritten.names().empty() && day.steps == job.plan.course.steps.size()) job.store.finish();
  });
  if (run.json) {
    fmt::print("{}", text);
  } else if (!run.quiet) {
    fmt::print("{}{}\n", day_report(summary), job.folder.string());
  }
  written.unwritten.throw_if_any(resume_hint);
}

// Simulates the steps until they are done, --max-seconds have passed or Ctrl-C stops them; an error leaves the finished steps
// in place.
SimulatedDay run_steps(Simulation& simulation, const DayJob& job, const SolveSettings& settings, Ranks& ranks) {
  ProgressLine line("day");
  RunHooks hooks{terminal_monitor(line), nullptr, &ranks};
  const Stopwatch clock;
  const std::optional<double>& max_seconds = job.options.run.max_seconds;
  hooks.monitor.interrupted = [&] { return interrupted() || (max_seconds && clock.seconds() >= *max_seconds); };
  FolderSink sink(job.store, job.plan.course, wanted_fields(job.options.run, job.plan.course));
  try {
    SimulatedDay day = simulate_day(simulation, job.plan, settings, sink, hooks);
    sink.wait();
    return day;
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) + resume_hint);
  }
}

int warn_if_stopped(const DayCourse& course, const SimulatedDay& day, const RunOptions& options, bool interrupted) {
  if (day.steps < course.steps.size()) {
    const std::string why = interrupted ? "interrupted" : fmt::format("stopped after --max-seconds {}", *options.max_seconds);
    warn(fmt::format("{} after {} of {} steps; they are kept, and --resume continues the day", why, day.steps,
                     course.steps.size()));
    return interrupted ? exit_interrupted : exit_short_of_bound;
  }
  if (day.totals.short_of_bound == 0) return exit_done;
  warn(fmt::format("{} of {} steps stopped at --max-rays {} short of their bound; the results are marked incomplete",
                   day.totals.short_of_bound, course.steps.size(), options.max_rays.value_or(0)));
  return exit_short_of_bound;
}

// Returns the solver's settings for the steps: the light of triangles is estimated only where it is wanted.
SolveSettings settings_of(const DayOptions& options, const Scene& scene, const DayPlan& plan) {
  WorkRequest work = options.run;
  work.triangle_light = wanted_fields(options.run, plan.course) == StepFields::kept;
  return day_solve_settings(work, scene, options.run.threads);
}

std::string task_of(const DayOptions& options, const DayPlan& plan, const SolveSettings& settings) {
  const std::string command =
      fmt::format("day of {} to {}, {} to {} in steps of {} min", plan.course.dates.front(), plan.course.dates.back(),
                  clock_text(plan.from_min), clock_text(plan.to_min), options.step_min);
  return task_text(command, options.run, options.run, settings);
}

// Does the part of a rank other than 0 in a day.
int help_with_day(const DayOptions& options, Ranks& ranks) {
  const bool served = ranks.serve([&](const auto& make_replicates) {
    Scene scene = load_scene_with_warnings(options.run, ScenePurpose::day);
    const DayPlan plan = plan_day(options, scene);
    Simulation simulation(std::move(scene), options.run);
    const SolveSettings settings = settings_of(options, simulation.scene(), plan);
    make_replicates({simulation, settings, task_of(options, plan, settings),
                     [&](std::uint64_t block) { return lights_of(simulation.model(), plan, block_of(block)); }});
  });
  return served ? exit_done : exit_failed;
}

// Throws Error (input) if the folder holds the result of another command, which a day that begins would remove.
void expect_no_other_result(const fs::path& folder) {
  const std::optional<std::string> command = other_result_in(folder, ResultOf::day);
  if (!command) return;
  throw_input(fmt::format("--resume {}", printable(folder.string())),
              fmt::format("the folder holds the result of {}, not of a day", *command),
              "choose another folder with -o, or omit --resume to replace that result");
}

// Prepares the folder for the steps that are still to be simulated.
void open_day_folder(const fs::path& folder, FolderLock& lock, StepStore& store, bool resumed) {
  if (resumed) {
    reopen_folder(folder);
  } else {
    prepare_folder(folder, lock, ResultOf::day);
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

  Scene scene = load_scene_with_warnings(run, ScenePurpose::day);
  DayPlan plan = plan_day(options, scene);
  for (const std::string& warning : plan_warnings(plan, scene)) warn(warning);
  const SolveSettings settings = settings_of(options, scene, plan);
  if (run.resume && !options.steps_together) options.steps_together = noted_steps_together(folder);
  plan_blocks(options, settings, scene.model, plan);
  check_folder(folder, scene, ResultOf::day);
  check_grid(run, scene);
  static_cast<void>(picture_band(scene.model, run.pictures.band));
  const ordered_json kept_settings = day_settings(options, scene, settings, plan, wanted_fields(run, plan.course));
  StepStore store(folder, scene.model, kept_settings, wanted_fields(run, plan.course));
  const StepStore::Found found = run.resume ? store.find() : StepStore::Found::nothing;
  if (run.resume && found == StepStore::Found::nothing) expect_no_other_result(folder);
  if (found == StepStore::Found::finished) {
    expect_plane_maps(folder, run, scene.model);
    return report_finished(folder, run, "day");
  }
  const double load_s = watch.lap();

  Simulation simulation(std::move(scene), run);
  ranks.gather(simulation, settings, task_of(options, plan, settings));
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

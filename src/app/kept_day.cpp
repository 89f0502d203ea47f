#include "app/kept_day.h"

#include "app/day_steps.h"
#include "app/repeated_simulation.h"
#include "app/simulation.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace sunfleck {
namespace {

double lit_steps(const DayCourse& course) {
  return static_cast<double>(
      std::count_if(course.steps.begin(), course.steps.end(), [](const DayStep& step) { return !step.night(); }));
}

// Whether all steps are done.
bool run_steps(KeptDay& day, DaySteps& steps, const StopQuestion& stop, const Monitor& monitor) {
  const double lit = lit_steps(day.plan.course);
  const auto report = [&](const Progress& state) {
    if (!monitor.report) return;
    Progress whole = state;
    whole.rays += steps.totals().rays + steps.totals().packets;
    whole.fraction = (static_cast<double>(steps.totals().simulated) + state.fraction) / lit;
    monitor.report(whole);
  };
  for (std::size_t i = 0; i < day.plan.course.steps.size(); ++i) {
    if (stop()) return false;
    if (day.plan.course.steps[i].night()) {
      day.lights.push_back(night_light(day.scene.model));
      day.fields.emplace_back();
      continue;
    }
    std::optional<StoredStep> step = steps.simulate(i, stop, report);
    if (!step) return false;
    steps.count(*step);
    day.lights.push_back(std::move(step->light));
    day.fields.push_back(std::move(step->fields));
  }
  return true;
}

}  // namespace

KeptDay simulate_day(Scene scene, const DayOptions& options, const Monitor& monitor) {
  Stopwatch total;
  KeptDay day{std::move(scene), {}, {}, {}, {}, {}};
  RadiationModel& model = day.scene.model;
  model.planes.clear();
  model.sensors.clear();
  day.plan = plan_day(options, day.scene);
  SolveSettings settings = solve_settings(options.run, day.scene);
  settings.element_errors = ElementErrors::keep;
  settings.max_seconds.reset();
  check_grid(options.run, day.scene);

  set_software_threads(options.run.threads);
  const CpuThreads threads(options.run.threads);
  TracingKit kit(model, options.run.device);
  day.record = make_record(options.run, day.scene, settings, kit.engine);
  day.record.max_seconds = options.run.max_seconds;

  DaySteps steps(model, day.plan, settings, kit.tree.layout, kit.engine);
  const auto begin = std::chrono::steady_clock::now();
  const auto stop = [&] {
    const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return (monitor.interrupted && monitor.interrupted()) || (options.run.max_seconds && spent_s >= *options.run.max_seconds);
  };
  const bool all = run_steps(day, steps, stop, monitor);
  day.record.complete = all && steps.totals().short_of_bound == 0;
  day.record.seconds.total = total.lap();
  const nlohmann::ordered_json kept = day_settings(options, day.scene, settings, day.plan);
  day.summary = day_summary_json({day.record, model, day.plan.course, day.lights, steps.totals(), kept});
  return day;
}

}  // namespace sunfleck

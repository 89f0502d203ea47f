#include "app/day_steps.h"

#include "app/simulation.h"
#include "base/random.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

// next_work foresees replicates of which sixteen reach 0.7 of the bounds, so that a run rarely fails its checks: half of its
// work is spare. With fewer packets each, a step makes as many replicates as it takes, and the spare work is what lies between
// two checks. Rays cost little beside packets, and a beam that lags behind would cost all packets of more replicates.
constexpr double share_of_next_packets = 0.4;
// The sun may have moved to where much more work is needed, as when the first beams reach the ground. Where after so many
// replicates the error is still so many bounds, a step begins anew with pilots: it would need 75 replicates, not some 20.
constexpr int judged_replicates = 12;
constexpr double most_bounds = 2.5;

template <class T>
ordered_json value_or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

}  // namespace

ordered_json day_settings(const DayOptions& options, const Scene& scene, const SolveSettings& settings, const DayPlan& plan) {
  return {{"sunfleck", version()},
          {"scene_digest", scene.digest},
          {"date", plan.course.dates.front()},
          {"to_date", plan.course.dates.back()},
          {"step_min", options.step_min},
          {"from", clock_text(plan.from_min)},
          {"to", clock_text(plan.to_min)},
          {"seed", settings.seed},
          {"direct_error", settings.accuracy.direct},
          {"indirect_error", settings.accuracy.indirect},
          {"confidence", settings.accuracy.confidence},
          {"of", error_target_name(settings.accuracy.of)},
          {"grid_m", value_or_null(settings.grid_m)},
          {"passes", value_or_null(settings.passes)},
          {"max_rays", value_or_null(settings.max_rays)}};
}

void set_light(RadiationModel& model, const MomentLight& light) {
  model.sun = light.sun;
  model.bands = light.bands;
  model.sky = light.sky;
}

DaySteps::DaySteps(RadiationModel& model, const DayPlan& plan, const SolveSettings& settings, const CounterLayout& layout,
                   Engine& engine, ReplicateHelpers* helpers)
    : model_(model), plan_(plan), settings_(settings), layout_(layout), engine_(engine), helpers_(helpers) {}

std::optional<StoredStep> DaySteps::simulate(std::size_t step, const StopQuestion& stop,
                                             const std::function<void(const Progress&)>& report) {
  set_light(model_, plan_.lights[step]);
  SolveSettings settings = settings_;
  settings.seed = RandomStream(settings_.seed, step).word();
  if (next_work_ && !settings.grid_m && !settings.passes) {
    settings.begin_with = Work{next_work_->rays, share_of_next_packets * next_work_->packets};
  }
  Stopwatch watch;
  std::optional<RadiationResult> attempt = solve_step(settings, stop, report);
  if (!attempt) {
    settings.begin_with.reset();
    attempt = solve_step(settings, stop, report);
  }
  const RadiationResult& result = *attempt;
  check_validation(engine_);
  if (result.stop == StopReason::interrupted) return std::nullopt;
  StoredStep stored;
  stored.light = step_light(model_, result);
  stored.fields = day_fields(model_, result);
  stored.next_work = result.next_work;
  stored.rays = result.direct.rays;
  stored.packets = result.indirect.packets;
  stored.lost_rays = result.lost_rays;
  stored.direct_error = result.direct.relative_error;
  stored.indirect_error = result.indirect.relative_error;
  stored.reached_bound = is_done(result.stop);
  stored.seconds = watch.lap();
  return stored;
}

// Empty if it began with far too little work; what decides that are counts, not the clock.
std::optional<RadiationResult> DaySteps::solve_step(const SolveSettings& settings, const StopQuestion& stop,
                                                    const std::function<void(const Progress&)>& report) {
  std::atomic<bool> too_little = false;  // the solver's threads read it
  int replicates = 0;
  Monitor monitor;
  monitor.interrupted = [&] { return too_little || stop(); };
  monitor.report = [&](const Progress& state) {
    ++replicates;
    const bool judged = settings.begin_with && replicates == judged_replicates;
    if (judged && state.relative_error.value_or(0.0) > most_bounds * state.bound) too_little = true;
    if (report) report(state);
  };
  RadiationResult result = solve(model_, layout_, engine_.tracer(), settings, monitor, helpers_);
  if (too_little) return std::nullopt;
  return result;
}

void DaySteps::count(const StoredStep& step) {
  const auto worse = [](std::optional<double>& worst, const std::optional<double>& error) {
    if (error) worst = std::max(worst.value_or(0.0), *error);
  };
  ++totals_.simulated;
  totals_.short_of_bound += step.reached_bound ? 0 : 1;
  totals_.rays += step.rays;
  totals_.packets += step.packets;
  totals_.lost_rays += step.lost_rays;
  worse(totals_.direct_error, step.direct_error);
  worse(totals_.indirect_error, step.indirect_error);
  totals_.seconds += step.seconds;
  next_work_ = step.next_work;
}

}  // namespace sunfleck

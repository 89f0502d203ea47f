#include "simulate/day.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "base/version.h"
#include "files/results/tables/day_fields.h"
#include "files/results/tables/organ_kinds.h"
#include "files/results/tables/plane_day.h"
#include "files/results/tables/work_settings.h"
#include "simulate/day_blocks.h"
#include "simulate/ranks.h"
#include "simulate/state_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <utility>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

// next_work sizes replicates so that sixteen of them just reach the bounds. With fewer packets in each replicate, a step whose
// light is easier than the last one's has not yet made too many when its bounds are checked first. Rays cost little compared
// with packets, and a beam that lags behind would cost all packets of more replicates.
constexpr double share_of_next_packets = 0.8;
constexpr double share_of_next_rays = 1.6;
// The sun may have moved to where much more work is needed, for example when the first beams reach the ground. If the error is
// still this many times the bound after this many replicates, the step starts again with pilots: otherwise it would need 75
// replicates instead of about 20.
constexpr std::size_t judged_replicates = 12;
constexpr double most_bounds = 2.5;

class DayRun {
 public:
  DayRun(Simulation& simulation, const DayPlan& plan, const SolveSettings& settings, DaySink& sink, const RunHooks& hooks)
      : simulation_(simulation), plan_(plan), settings_(settings), sink_(sink), hooks_(hooks), kinds_(simulation.model()) {
    const auto& steps = plan.course.steps;
    for (std::size_t date = 0; date < plan.course.dates.size(); ++date)
      of_hour_.resize(std::max(of_hour_.size(), steps_of(plan.course, date).size()));
    lit_steps_ = static_cast<double>(std::count_if(steps.begin(), steps.end(), [](const DayStep& s) { return !s.unlit(); }));
  }

  SimulatedDay run() {
    for (const DayBlock& block : plan_.blocks) {
      if (hooks_.interrupted()) break;
      day_.steps = block.first;  // the unlit ones before it
      if (!find(block) && !simulate(block)) return day_;
    }
    if (!hooks_.interrupted()) day_.steps = plan_.course.steps.size();
    return day_;
  }

 private:
  // Takes over a block whose steps were all simulated earlier.
  [[nodiscard]] bool find(const DayBlock& block) {
    std::vector<StoredStep> steps;
    for (std::size_t i = block.first; i < block.end; ++i) {
      std::optional<StoredStep> step = sink_.find(i);
      if (!step) return false;
      steps.push_back(*std::move(step));
    }
    for (std::size_t k = 0; k < steps.size(); ++k) count(block.first + k, steps[k]);
    return true;
  }

  // Returns the settings with the seed of a step. Each step's sensors have that seed, too, so that the errors of their readings are
  // independent and those of a date's sums follow from them.
  [[nodiscard]] SolveSettings with_seed_of(std::size_t step, SolveSettings settings) const {
    settings.seed = RandomStream(settings_.seed, step).word();
    return settings;
  }

  // Simulates the daytime steps of a block; returns false if it was stopped meanwhile.
  [[nodiscard]] bool simulate(const DayBlock& block) {
    if (hooks_.ranks != nullptr) hooks_.ranks->set_stage(number_of(block));
    SolveSettings settings = with_seed_of(block.first, settings_);
    // A limit of rays may be too low for the work of an earlier step, but never is for pilots.
    if (!settings.grid_m && !settings.passes && !settings.max_rays) settings.begin_with = work_to_begin_with(block);
    const std::optional<SolveState> left = find_state(block, settings);
    settings.resume_from = left ? &*left : nullptr;
    if (left) say(fmt::format("resuming step{} after {} replicates", steps_text(block), left->replicates()));
    if (!solve(block, settings)) {
      settings.begin_with.clear();
      settings.resume_from = nullptr;
      static_cast<void>(solve(block, settings));
    }
    simulation_.check_validation();
    return day_.steps == block.end;
  }

  // Returns the state that an earlier process left of the first block that it did not finish. If that block had begun with too
  // little work and begun again, `settings` will not begin with it once more. A state that is damaged, or of another block, is
  // of no use.
  [[nodiscard]] std::optional<SolveState> find_state(const DayBlock& block, SolveSettings& settings) {
    if (std::exchange(has_looked_, true)) return std::nullopt;
    const std::optional<RunStore> any = sink_.block_store(block_settings(block, settings));
    if (!any || !any->exists()) return std::nullopt;
    const StateShape shape =
        state_shape(lights_of(simulation_.model(), plan_, block), simulation_.layout(), settings, wanted_sums(block));
    const auto find = [&]() -> std::optional<SolveState> {
      try {
        return sink_.block_store(block_settings(block, settings))->read(shape);
      } catch (const Error&) {
        return std::nullopt;
      }
    };
    std::optional<SolveState> state = find();
    if (state || settings.begin_with.empty()) return state;
    const std::vector<Work> begin_with = std::exchange(settings.begin_with, {});
    state = find();
    if (!state) settings.begin_with = begin_with;
    return state;
  }

  static std::string steps_text(const DayBlock& block) {
    return block.size() == 1 ? fmt::format(" {}", block.end) : fmt::format("s {} to {}", block.first + 1, block.end);
  }

  [[nodiscard]] static ordered_json block_settings(const DayBlock& block, const SolveSettings& settings) {
    return {{"first_step", block.first}, {"begins_with_pilots", settings.begin_with.empty()}};
  }

  // Returns the work that a single step takes over from the last one, and that the steps of a block take over from those at the
  // same hours of an earlier date: the rays that a light needs vary too much in a few hours. Empty if there is none.
  [[nodiscard]] std::vector<Work> work_to_begin_with(const DayBlock& block) const {
    std::vector<Work> works;
    for (std::size_t i = block.first; i < block.end; ++i) {
      const std::optional<Work>& earlier = block.size() == 1 ? next_work_ : of_hour_[hour_of(i)];
      if (!earlier) return {};
      works.push_back({share_of_next_rays * earlier->rays, share_of_next_packets * earlier->packets});
    }
    return works;
  }

  // Returns the number of a step within its date.
  [[nodiscard]] std::size_t hour_of(std::size_t step) const {
    return step - steps_of(plan_.course, plan_.course.steps[step].date).first;
  }

  // Returns false if the block began with far too little work; counts decide that, not the clock.
  [[nodiscard]] bool solve(const DayBlock& block, const SolveSettings& settings) {
    std::atomic<bool> too_little = false;  // the solver's threads read it
    std::size_t replicates = settings.resume_from != nullptr ? settings.resume_from->replicates() : 0;
    Monitor monitor;
    const std::vector<RadiationModel> lights = lights_of(simulation_.model(), plan_, block);
    if (const std::optional<RunStore> store = sink_.block_store(block_settings(block, settings))) {
      keeper_.attend(monitor, *store, lights);
      // The state of a block that begins again would hide that it does.
      monitor.receive_state = [&, keep = monitor.receive_state](const SolveStateView& state) {
        if (!too_little) keep(state);
      };
    }
    monitor.interrupted = [&] { return too_little || hooks_.interrupted(); };
    monitor.report = [&](const Progress& state) {
      ++replicates;
      const bool judged = !settings.begin_with.empty() && replicates == judged_replicates;
      if (judged && state.bound && state.relative_error.value_or(0.0) > most_bounds * *state.bound) too_little = true;
      report(block, state);
    };
    const WantedSums sums = wanted_sums(block);
    Stopwatch watch;
    double shared_s = 0.0;  // each step's part of the time that all of them took
    const auto take = [&](std::size_t light, RadiationResult result, const SharedOutcome& outcome) {
      simulation_.add_sensors(lights[light], with_seed_of(block.first + light, settings), monitor, watch, result);
      // What stopped the block may have cut the light of its triangles short.
      if (too_little || hooks_.interrupted() || result.stop == StopReason::interrupted) return;
      StoredStep step = stored_step(lights[light], result);
      const double lap_s = watch.lap();
      if (light == 0) shared_s = lap_s / static_cast<double>(lights.size());
      step.seconds = shared_s + (light == 0 ? 0.0 : lap_s);
      step.light.shares_packets = lights.size() > 1;
      if (light > 0) step.packets = 0;  // they are those of the first step
      if (light == 0 && lights.size() > 1) step.light.of_shared = with_soil(outcome.sum_errors.front());
      sink_.take(block.first + light, step);
      count(block.first + light, step);
    };
    static_cast<void>(simulation_.solve_lights(lights, settings, monitor, hooks_.helpers(), sums, take));
    return !too_little;
  }

  // Returns the sum over the steps of a block that share packets, with the kinds of organs.
  [[nodiscard]] WantedSums wanted_sums(const DayBlock& block) const {
    if (block.size() == 1) return {};
    LightSum sum;
    for (std::size_t k = 0; k < block.size(); ++k) sum.push_back({k, plan_.course.steps[block.first + k].length_s});
    return {{sum}, kinds_.number_of};
  }

  // Returns errors for all kinds of organs: those of organs do not include the ground of [soil].
  [[nodiscard]] JointErrors with_soil(JointErrors errors) const {
    const std::size_t bands = errors.bands.size();
    errors.groups.resize(kinds_.of.size() * bands);
    for (std::size_t k = 0; k < kinds_.of.size(); ++k) {
      for (std::size_t b = 0; b < bands && kinds_.of[k].role == Role::soil; ++b)
        errors.groups[k * bands + b] = errors.bands[b].soil;
    }
    return errors;
  }

  [[nodiscard]] StoredStep stored_step(const RadiationModel& model, const RadiationResult& result) const {
    StoredStep stored;
    stored.light = step_light(model, result);
    if (sink_.fields() == StepFields::kept) stored.fields = day_fields(model, result);
    stored.maps = plane_maps(model, result);
    stored.next_work = result.next_work;
    stored.rays = result.direct.rays;
    stored.packets = result.indirect.packets;
    stored.lost_rays = result.lost_rays;
    stored.direct_error = result.direct.relative_error;
    stored.indirect_error = result.indirect.relative_error;
    stored.sensor_error = result.of_sensors.relative_error;
    stored.reached_bound = is_done(result.stop);
    return stored;
  }

  // Reports a block's progress as progress of the day.
  void report(const DayBlock& block, const Progress& state) const {
    if (!hooks_.monitor.report) return;
    Progress whole = state;
    whole.rays += day_.totals.rays + day_.totals.packets;
    const double of_block = state.fraction * static_cast<double>(block.size());
    whole.fraction = (static_cast<double>(day_.totals.simulated) + of_block) / lit_steps_;
    whole.seconds_left.reset();
    if (day_.totals.simulated > 0) whole.stage = Progress::Stage::run;
    hooks_.monitor.report(whole);
  }

  // Adds a step to the day, whether it was simulated now or earlier.
  void count(std::size_t number, const StoredStep& step) {
    const auto worse = [](std::optional<double>& worst, const std::optional<double>& error) {
      if (error) worst = std::max(worst.value_or(0.0), *error);
    };
    DayTotals& totals = day_.totals;
    ++day_.steps;
    ++totals.simulated;
    totals.short_of_bound += step.reached_bound ? 0 : 1;
    totals.rays += step.rays;
    totals.packets += step.packets;
    totals.lost_rays += step.lost_rays;
    worse(totals.direct_error, step.direct_error);
    worse(totals.indirect_error, step.indirect_error);
    worse(totals.sensor_error, step.sensor_error);
    totals.seconds += step.seconds;
    next_work_ = of_hour_[hour_of(number)] = step.next_work;
  }

  Simulation& simulation_;
  const DayPlan& plan_;
  const SolveSettings& settings_;
  DaySink& sink_;
  const RunHooks& hooks_;
  OrganKinds kinds_;
  double lit_steps_ = 0.0;
  StateKeeper keeper_{"day"};
  bool has_looked_ = false;                   // for the state of an earlier process
  std::optional<Work> next_work_;             // of the last step
  std::vector<std::optional<Work>> of_hour_;  // [number of a step within its date], of the last such step
  SimulatedDay day_;
};

// The largest block makes the same plan again.
constexpr const char* steps_together_key = "steps_together";

std::size_t largest_block(const DayPlan& plan) {
  std::size_t largest = 1;
  for (const DayBlock& block : plan.blocks) largest = std::max(largest, block.size());
  return largest;
}

}  // namespace

void plan_blocks(const DayRequest& request, const SolveSettings& settings, const RadiationModel& model, DayPlan& plan) {
  std::size_t most = 1;
  if (request.steps_together) {
    most = static_cast<std::size_t>(*request.steps_together);
  } else if (!settings.max_rays) {
    most = steps_in_memory(model, plan, refines(settings.element_errors), settings.memory_bytes.value());
  }
  plan_blocks(model, most, plan);
}

SolveSettings day_solve_settings(const WorkRequest& work, const Scene& scene, int threads) {
  SolveSettings settings = solve_settings(work, scene, threads);
  settings.max_seconds.reset();
  settings.memory_bytes = 0.5 * static_cast<double>(work.memory_bytes.value_or(available_memory_bytes() / 2));
  settings.shade_groups = ShadeGroups::leaves;
  return settings;
}

ordered_json day_settings(const DayRequest& request, const Scene& scene, const SolveSettings& settings, const DayPlan& plan,
                          StepFields fields) {
  ordered_json noted = {{"sunfleck", version()},
                        {"scene_digest", scene.digest},
                        {"date", plan.course.dates.front()},
                        {"to_date", plan.course.dates.back()},
                        {"step_min", request.step_min},
                        {"from", clock_text(plan.from_min)},
                        {"to", clock_text(plan.to_min)},
                        {steps_together_key, largest_block(plan)},
                        {"triangles", fields == StepFields::kept},
                        {"seed", settings.seed}};
  // Earlier versions simulated no step at night, and did not note this.
  if (plan.course.steps.front().lamps) noted["lamps"] = true;
  add_work_settings(noted, settings.accuracy, settings.grid_m, settings.passes, settings.max_rays);
  return noted;
}

std::optional<int> noted_steps_together(const std::filesystem::path& folder) {
  const std::optional<ordered_json> noted = noted_day_settings(folder);
  if (!noted) return std::nullopt;
  const auto steps = noted->find(steps_together_key);
  if (steps == noted->end() || !steps->is_number_unsigned()) return std::nullopt;
  const auto number = steps->get<std::uint64_t>();
  if (number < 1 || number > most_steps_together) return std::nullopt;
  return static_cast<int>(number);
}

SimulatedDay simulate_day(Simulation& simulation, const DayPlan& plan, const SolveSettings& settings, DaySink& sink,
                          const RunHooks& hooks) {
  return DayRun(simulation, plan, settings, sink, hooks).run();
}

}  // namespace sunfleck

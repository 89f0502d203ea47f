#include "physics/transport/solve/solve.h"

#include "base/check.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/solve/darkness.h"
#include "physics/transport/solve/foresight.h"
#include "physics/transport/solve/judge.h"
#include "physics/transport/solve/replicate_helpers.h"
#include "physics/transport/solve/replicate_queue.h"
#include "physics/transport/solve/result_of.h"
#include "physics/transport/solve/run_limits.h"
#include "physics/transport/solve/series.h"
#include "physics/transport/solve/work_planner.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

// First number of the pilots' replicates, apart from those of the run.
constexpr std::uint64_t pilot_stream = std::uint64_t{1} << 40U;

class Solver {
 public:
  Solver(Lights lights, const CounterLayout& layout, Tracer& tracer, const SolveSettings& settings, const Monitor& monitor,
         ReplicateHelpers* helpers, const WantedSums& wanted_sums, TakeLight take = nullptr)
      : lights_(lights),
        model_(lights.front()),
        settings_(settings),
        monitor_(monitor),
        wanted_sums_(wanted_sums),
        take_(std::move(take)),
        maker_(lights, layout, tracer),
        judge_(lights, settings, maker_.has_indirect_pass(), tracer, [&monitor] { return monitor.is_interrupted(); }),
        planner_(model_, settings, maker_),
        limits_(settings, monitor),
        queue_(maker_, settings.max_rays ? nullptr : helpers, [this] { return limits_.must_stop(); }) {}

  SharedOutcome run() {
    if (settings_.resume_from != nullptr) return resume(*settings_.resume_from);
    const bool told = !settings_.begin_with.empty() && !planner_.fixed();
    const std::optional<Work> work = told ? earlier_work() : choose_work();
    if (!work) return finish(limits_.reason());
    begin(*work);
    return run_on();
  }

  std::optional<RunForecast> forecast() {
    const std::optional<Work> work = choose_work();
    if (!work) return std::nullopt;
    const std::size_t certain = planner_.fixed() ? static_cast<std::size_t>(planner_.asked_replicates()) : first_check;
    return RunForecast{*work, planner_.replicate_bytes(*work), planner_.place_bytes(*work),
                       std::min(planner_.at_once(*work), certain)};
  }

 private:
  std::optional<Work> choose_work() {
    std::optional<Work> work = planner_.choose([this](const Work& pilot) { return run_pilots(pilot); });
    if (work && !ray_needs_.empty()) ray_shares_ = planner_.spare_rays(ray_needs_, *work);
    return work;
  }

  // Returns the work to begin with, and sets the lights' shares of its rays.
  Work earlier_work() {
    Work work = settings_.begin_with.front();
    for (const Work& of_light : settings_.begin_with) {
      work.rays = std::max(work.rays, of_light.rays);
      work.packets = std::max(work.packets, of_light.packets);
    }
    work = planner_.begin_with(work);
    for (std::size_t k = 0; lights_.size() > 1 && k < lights_.size(); ++k)
      ray_shares_.push_back(work.rays > 0.0 ? settings_.begin_with[k].rays / work.rays : 1.0);
    return work;
  }

  // Divides the rays among several lights by what pilots showed.
  void share_rays() {
    if (lights_.size() == 1 || planner_.fixed()) return;
    const ReplicateOrder made = order(series_->work);
    std::vector<double> rays;
    std::vector<SeriesOutcome> outcomes;
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      rays.push_back(made.rays_of(k));
      outcomes.push_back({series_->replicates(), judge_.direct_error(*series_, k), 0.0});
    }
    ray_needs_ = planner_.ray_needs(rays, outcomes, judge_.judged());
    ray_shares_ = planner_.ray_shares(ray_needs_);
  }

  // Makes pilots, which become the fallback, even if stopped.
  std::optional<SeriesOutcome> run_pilots(const Work& pilot) {
    const double before = limits_.seconds();
    begin(pilot, pilot_stream);
    while (series_->replicates() < pilot_replicates) {
      if (!add_replicate(pilot_replicates, pilot_replicates)) {
        keep_fallback();
        return std::nullopt;
      }
      report_pilot();
      if (series_->replicates() == glanced_pilots && planner_.far_too_small(outcome())) break;
    }
    queue_.end();  // replicates in the making use the tracer, too
    judge_.judge_triangles(*series_);
    share_rays();
    SeriesOutcome pilots = outcome();
    pilots.rays_each = static_cast<double>(series_->traced()) / static_cast<double>(pilots.replicates);
    pilots.seconds_each = (limits_.seconds() - before) / static_cast<double>(pilots.replicates);
    pilots.seconds_left = limits_.seconds_left().value_or(0.0);
    keep_fallback();
    return pilots;
  }

  [[nodiscard]] SeriesOutcome outcome() const {
    return {series_->replicates(), judge_.direct_error(*series_), judge_.indirect_error(*series_)};
  }

  // Begins a series of replicates; those of pilots have separate numbers.
  void begin(const Work& work, std::uint64_t stream = 0) {
    queue_.end();
    begun_with_ = 0;
    begun_s_ = limits_.seconds();
    completion_ = {};
    judge_.begin_series();
    ReplicateOrder first = order(work);
    first.number = stream;
    std::vector<Incidence> incidences;
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      Incidence& incidence = incidences.emplace_back(maker_.incidence(first.rays_of(k), first.aimed, k));
      incidence.packets = work.packets / static_cast<double>(lights_.size());
      incidence.sky_rays = first.sky_rays;
    }
    series_ = std::make_unique<Series>(maker_, incidences, settings_, wanted_sums_);
    series_->work = work;
    series_->ray_shares = ray_shares_;
    queue_.begin(first, series_->conversions, planner_.at_once(work));
  }

  // Returns the order of the first replicate of a series. A grid that is asked for is the same everywhere.
  [[nodiscard]] ReplicateOrder order(const Work& work) const {
    ReplicateOrder order{work.rays,     !settings_.grid_m, work.packets, planner_.sky_rays(work), settings_.accuracy.indirect,
                         settings_.seed};
    order.sampled_rays = planner_.sampled_rays(work);
    order.counts_hits = keeps_spreads(settings_.element_errors);
    for (const double share : ray_shares_) {
      order.ray_shares.push_back(std::clamp(share, std::min(1.0, first_pilot.rays / std::max(1.0, work.rays)), 1.0));
    }
    return order;
  }

  // Adds one replicate, and starts others: among the first `certain` ones or, where workers would be idle, among the first
  // `possible` ones. Returns false if the run has to end before the replicate is complete.
  bool add_replicate(std::size_t certain, std::size_t possible) {
    std::optional<ReplicateSet> made = queue_.next(std::max(certain, begun_with_) - begun_with_, possible - begun_with_);
    if (!made) return false;
    series_->add(*made);
    release_fallback();
    traced_ += series_->grid_rays;
    if (const auto& packets = made->front().packets) {
      traced_ += packets->packets + packets->sky_rays;
      planner_.learn(series_->work, *packets);
    }
    for (const Replicate& replicate : *made) {
      direct_s_ += replicate.direct_s;
      indirect_s_ += replicate.indirect_s;
    }
    maker_.take_back(*std::move(made));
    hand_over();
    return true;
  }

  // Hands the result so far to the monitor.
  void hand_over() {
    if (!monitor_.wants_result || !monitor_.wants_result()) return;
    const bool use_fallback = fallback_ && series_->traced() < fallback_->traced();
    const Series& shown = use_fallback ? *fallback_ : *series_;
    RadiationResult result = figures_of_series(shown, 0, StopReason::interrupted);
    copy_arrays(shown.front(), result);
    monitor_.receive_result(std::move(result));
  }

  void report_pilot() const {
    if (!monitor_.report) return;
    monitor_.report({.stage = Progress::Stage::pilot, .rays = traced_});
  }

  // `expected` is the number of replicates of the whole run, as far as it is known.
  void report(std::size_t expected) {
    if (!monitor_.report) return;
    const double direct = judge_.direct_error(*series_);
    const double indirect = judge_.indirect_error(*series_);
    const bool direct_lags = direct / settings_.accuracy.direct >= indirect / settings_.accuracy.indirect;
    Progress progress{.rays = traced_};
    progress.pass = direct_lags ? Progress::Pass::direct : Progress::Pass::indirect;
    if (!planner_.fixed()) progress.bound = direct_lags ? settings_.accuracy.direct : settings_.accuracy.indirect;
    if (!std::isnan(direct + indirect)) progress.relative_error = direct_lags ? direct : indirect;
    const auto done = static_cast<double>(series_->replicates());
    const double each_s = (limits_.seconds() - begun_s_) / std::max(1.0, done - static_cast<double>(begun_with_));
    const double left = std::min(static_cast<double>(expected) - done,
                                 limits_.affordable_replicates(each_s, series_->traced(), series_->replicates()));
    progress.fraction = completion_.update(done, done + left);
    progress.seconds_left = left * each_s;
    monitor_.report(progress);
  }

  // Frees the pilots' sums as soon as no result will be made from them.
  void release_fallback() {
    if (fallback_ && series_->replicates() >= 2 && series_->traced() >= fallback_->traced()) fallback_.reset();
  }

  void keep_fallback() {
    if (series_ && series_->replicates() >= 2) {
      fallback_ = std::move(series_);
    }
    series_.reset();
  }

  SharedOutcome resume(const SolveState& state) {
    ray_shares_ = state.ray_shares;
    begin(state.work, state.replicates());
    ENSURE(restore(*series_, state.sums), ==, true);
    begun_with_ = series_->replicates();
    traced_ = series_->traced();
    next_check_ = state.next_check;
    return run_on();
  }

  SharedOutcome run_on() { return planner_.fixed() ? run_fixed() : run_to_bound(); }

  SharedOutcome run_fixed() {
    const auto all = static_cast<std::size_t>(planner_.asked_replicates());
    while (series_->replicates() < all) {
      if (spent() || !add_replicate(all, all)) return finish(limits_.reason());
      report(all);
      if (monitor_.wants_state && monitor_.wants_state()) keep_state();
    }
    return finish(StopReason::work_done);
  }

  // The run ends at the first good check. That keeps the intervals true: with at least 12 replicates, ending where the error
  // happens to be small costs less than one percent of coverage.
  SharedOutcome run_to_bound() {
    while (true) {
      const bool was_stopped_at_check = series_->replicates() >= next_check_;
      if (!was_stopped_at_check && (spent() || !add_replicate(next_check_, most_replicates))) return finish(limits_.reason());
      const std::size_t done = series_->replicates();
      const bool due = done >= next_check_;
      if (due) judge_.judge_triangles(*series_);
      // It may have cut the judgement of triangles short.
      if (due && monitor_.is_interrupted()) return finish(StopReason::interrupted);
      const bool good = due && judge_.bounds_hold(*series_);
      report(good ? done : std::max(judge_.needed_replicates(*series_), due ? done + 1 : next_check_));
      if (good) return finish(StopReason::bound_reached);
      if (done >= most_replicates) return finish(StopReason::replicates_spent);
      if (due) next_check_ = check_after(done, judge_.needed_replicates(*series_), settings_.accuracy.of);
      if (monitor_.wants_state && monitor_.wants_state()) keep_state();
    }
  }

  void keep_state() const {
    if (!monitor_.receive_state || series_->replicates() < 2 || planner_.fitted_to_time()) return;
    monitor_.receive_state({series_->work, ray_shares_, next_check_, pieces_of(*series_)});
  }

  // Returns true if the next replicate would need more rays than are left.
  bool spent() {
    const std::size_t done = series_->replicates();
    const std::uint64_t run = series_->traced();
    return limits_.lacks_rays(run, done > 0 ? run / done : series_->grid_rays);
  }

  SharedOutcome finish(StopReason reason) {
    queue_.end();
    maker_.free_spare_memory();
    if (!is_done(reason) && series_) keep_state();
    const bool use_fallback = fallback_ && (!series_ || series_->replicates() < 2);
    if (use_fallback) {
      series_ = std::move(fallback_);
      ray_shares_ = series_->ray_shares;
    } else if (!series_) {
      begin(first_pilot);
    }
    SharedOutcome outcome_of_all{reason, {}};
    const double quantile = t_quantile(settings_.accuracy.confidence, series_->replicates());
    if (lights_.size() > 1 && reason == StopReason::interrupted) return outcome_of_all;
    std::vector<RadiationResult> results;
    for (std::size_t k = 0; k < lights_.size(); ++k) results.push_back(figures_of_series(*series_, k, reason));
    set_next_work(results);
    for (const JointSums& sum : series_->joint) outcome_of_all.sum_errors.push_back(sum.errors(quantile, results));
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      RunSums& sums = *series_->sums[k];
      RadiationResult result = std::move(results[k]);
      result.work = series_->work;
      move_arrays(sums, result);
      judge_.refine(k, sums, result);
      take_(k, std::move(result), outcome_of_all);
    }
    return outcome_of_all;
  }

  // Gives each light's result the work that suits a similar light: rays by its own error, packets by the largest.
  void set_next_work(std::vector<RadiationResult>& results) const {
    const ReplicateOrder made = order(series_->work);
    const double indirect = judge_.indirect_error(*series_);
    for (std::size_t k = 0; k < results.size(); ++k) {
      const Work own{made.rays_of(k), series_->work.packets};
      results[k].next_work = planner_.next(own, {series_->replicates(), judge_.direct_error(*series_, k), indirect});
    }
  }

  [[nodiscard]] RadiationResult figures_of_series(const Series& series, std::size_t light, StopReason reason) const {
    RadiationResult result = figures_of(*series.sums[light], settings_.accuracy.confidence);
    result.stop = reason;
    result.direct.replicates = series.replicates();
    result.direct.rays = series.replicates() * series.light_rays[light];
    if (result.direct.rays > 0) {
      result.direct.grid_m = std::sqrt(model_.plot.area_m2() / static_cast<double>(result.direct.rays));
    }
    const auto tell = [](const std::optional<JudgedError>& error, auto& summary) {
      if (!error || std::isnan(error->relative)) return;
      summary.relative_error = error->relative;
      summary.judged = error->figure;
    };
    tell(judge_.direct_error_of(series, light), result.direct);
    tell(judge_.indirect_error_of(series, light), result.indirect);
    if (!lights_[light].has_beam()) result.direct.relative_error = 0.0;
    // Replicates overlap, so the elapsed time is divided in proportion to the time spent in each pass.
    const double busy_s = direct_s_ + indirect_s_;
    result.indirect.seconds = busy_s > 0.0 ? limits_.seconds() * indirect_s_ / busy_s : 0.0;
    result.direct.seconds = limits_.seconds() - result.indirect.seconds;
    if (!planner_.fixed()) {
      result.direct.bound = settings_.accuracy.direct;
      if (maker_.has_indirect_pass()) result.indirect.bound = settings_.accuracy.indirect;
    }
    return result;
  }

  Lights lights_;
  const RadiationModel& model_;  // the first light
  const SolveSettings& settings_;
  const Monitor& monitor_;
  const WantedSums& wanted_sums_;
  TakeLight take_;
  std::vector<double> ray_needs_, ray_shares_;  // [light]; empty for a single one, and until pilots have shown them
  ReplicateMaker maker_;
  Judge judge_;
  WorkPlanner planner_;
  RunLimits limits_;
  std::unique_ptr<Series> series_, fallback_;
  std::uint64_t traced_ = 0;
  std::size_t next_check_ = first_check;
  std::size_t begun_with_ = 0;  // replicates that an earlier process made
  double begun_s_ = 0.0;        // time at which this series began
  Completion completion_;
  double direct_s_ = 0.0, indirect_s_ = 0.0;
  ReplicateQueue queue_;  // declared last, so that it is destroyed first
};

}  // namespace

std::optional<RunForecast> forecast(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                    const SolveSettings& settings, const Monitor& monitor) {
  if (is_dark(model)) return RunForecast{};
  const WantedSums no_sums;
  return Solver({&model, 1}, layout, tracer, settings, monitor, nullptr, no_sums).forecast();
}

RadiationResult solve(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const SolveSettings& settings,
                      const Monitor& monitor, ReplicateHelpers* helpers) {
  std::optional<RadiationResult> result;
  const auto take = [&](std::size_t, RadiationResult of_light, const SharedOutcome&) { result = std::move(of_light); };
  static_cast<void>(solve_lights({&model, 1}, layout, tracer, settings, monitor, helpers, {}, take));
  return *std::move(result);
}

SharedOutcome solve_lights(Lights lights, const CounterLayout& layout, Tracer& tracer, const SolveSettings& settings,
                           const Monitor& monitor, ReplicateHelpers* helpers, const WantedSums& sums, const TakeLight& take) {
  if (lights.size() == 1 && is_dark(lights.front())) {
    SharedOutcome outcome{StopReason::bound_reached, {}};
    take(0, dark_result(lights.front(), layout, settings), outcome);
    return outcome;
  }
  return Solver(lights, layout, tracer, settings, monitor, helpers, sums, take).run();
}

}  // namespace sunfleck

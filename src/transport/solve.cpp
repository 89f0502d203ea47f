#include "transport/solve.h"

#include "base/check.h"
#include "light/beam_grid.h"
#include "transport/darkness.h"
#include "transport/foresight.h"
#include "transport/judged_error.h"
#include "transport/packet_memory.h"
#include "transport/replicate_helpers.h"
#include "transport/replicate_maker.h"
#include "transport/replicate_queue.h"
#include "transport/run_sums.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace sunfleck {
namespace {

constexpr int pilot_replicates = 8;
constexpr double first_pilot_rays = 16384;
constexpr double first_pilot_packets = 4096;
// A pilot is trusted to forecast work up to this multiple of its own; beyond it a larger pilot follows, at a few percent of
// the cost.
constexpr double trusted_refinement = 16;
// Exponents by which errors fall. The sampling error of a jittered grid falls with rays^-3/4 on shadow edges (validation
// G3), and more slowly while its cells are not yet small compared with the leaves: rays^-0.6 gave the best forecasts from
// pilots on maize. The error of packets falls with packets^-1/2.
constexpr double ray_slope = 0.6;
constexpr double packet_slope = 0.5;
// Number of replicates for which the work is chosen, and the part of the bound to aim at, so that the checks rarely fail by
// chance.
constexpr int planned_replicates = 16;
constexpr double aimed_part_of_bound = 0.7;
// Sky rays per packet of the first round when the work is not fixed, and the largest number of sky rays in one replicate.
constexpr double sky_rays_per_packet = 2.0;
constexpr double most_sky_rays = 0x1p22;
// A replicate whose packets take more memory than this gains nothing: more replicates do the same work.
constexpr double comfortable_bytes = 0x1p28;
// First number of the pilots' replicates, apart from those of the run.
constexpr std::uint64_t pilot_stream = std::uint64_t{1} << 40U;

double steady_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Replicates with the same work.
struct Series {
  Series(const ReplicateMaker& maker, const Incidence& incidence, ElementErrors element_errors)
      : conversion(maker.conversion(incidence)), sums(conversion, element_errors), grid_rays(incidence.rays) {}

  // Returns the number of rays and packets.
  [[nodiscard]] std::uint64_t traced() const { return sums.replicates * grid_rays + sums.packets + sums.sky_rays; }

  Conversion conversion;
  RunSums sums;             // refers to the conversion, so that a series cannot be copied or moved
  std::uint64_t grid_rays;  // of each replicate
};

class Solver {
 public:
  Solver(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const SolveSettings& settings,
         const Monitor& monitor, ReplicateHelpers* helpers)
      : model_(model),
        settings_(settings),
        monitor_(monitor),
        maker_(model, layout, tracer),
        memory_(model),
        queue_(maker_, settings.max_rays ? nullptr : helpers, [this] { return must_stop(); }) {}

  RadiationResult run() {
    if (settings_.resume_from != nullptr) return go_on(*settings_.resume_from, asked_replicates());
    if (settings_.begin_with && !fixed()) return begin_as_told(*settings_.begin_with);
    const std::optional<Work> work = work_of_run();
    if (!work) return finish(stop_);
    begin(*work);
    return fixed() ? run_fixed(asked_replicates()) : run_to_bound();
  }

  std::optional<RunForecast> forecast() {
    const std::optional<Work> work = work_of_run();
    if (!work) return std::nullopt;
    work_ = *work;
    return RunForecast{*work, replicate_bytes(*work), replicates_at_once()};
  }

 private:
  [[nodiscard]] bool has_indirect() const { return maker_.has_indirect_pass(); }
  [[nodiscard]] bool fixed() const { return settings_.grid_m || settings_.passes; }
  [[nodiscard]] double clock_s() const { return monitor_.clock_s ? monitor_.clock_s() : steady_clock_s(); }
  [[nodiscard]] double seconds() const { return clock_s() - start_s_; }

  // Returns true once the run has to end, and records the reason. Any thread may call it.
  bool must_stop() {
    const std::lock_guard lock(stop_mutex_);
    if (monitor_.interrupted && monitor_.interrupted()) {
      stop_ = StopReason::interrupted;
      return true;
    }
    if (settings_.max_seconds && seconds() >= *settings_.max_seconds) {
      stop_ = StopReason::time_spent;
      return true;
    }
    return false;
  }

  [[nodiscard]] int asked_replicates() const {
    return settings_.passes.value_or(settings_.grid_m ? fixed_grid_replicates : planned_replicates);
  }

  // Returns nothing if stopped.
  std::optional<Work> work_of_run() {
    const int replicates = asked_replicates();
    const bool needs_pilot = !settings_.grid_m || (has_indirect() && !settings_.packets);
    std::optional<Work> work = needs_pilot ? choose_work(replicates) : Work{};
    if (!work || !settings_.grid_m) return work;
    work->rays = grid_rays_asked(replicates);
    work->packets = settings_.packets.value_or(std::max(first_pilot_packets, work->packets));
    return work;
  }

  // Begins a series of replicates; those of pilots have separate numbers.
  void begin(const Work& work, std::uint64_t stream = 0) {
    queue_.end();
    work_ = work;
    begun_with_ = 0;
    begun_s_ = seconds();
    completion_ = {};
    Incidence incidence = maker_.incidence(work.rays);
    incidence.packets = work.packets;
    incidence.sky_rays = sky_rays(work);
    series_ = std::make_unique<Series>(maker_, incidence, settings_.element_errors);
    queue_.begin({work.rays, incidence.rays, work.packets, sky_rays(work), settings_.accuracy.indirect, settings_.seed, stream},
                 series_->conversion, replicates_at_once());
  }

  // A fixed grid sets the number of sky rays too.
  [[nodiscard]] std::size_t sky_rays(const Work& work) const {
    if (!maker_.has_sky()) return 0;
    const double rays = settings_.grid_m && !settings_.packets ? work.rays : sky_rays_per_packet * work.packets;
    return static_cast<std::size_t>(std::clamp(rays, 1.0, most_sky_rays));
  }

  // Adds one replicate, and starts others: among the first `certain` ones or, where workers would be idle, among the first
  // `possible` ones. Returns false if the run has to end before the replicate is complete.
  bool add_replicate(std::size_t certain, std::size_t possible) {
    const std::optional<Replicate> replicate =
        queue_.next(std::max(certain, begun_with_) - begun_with_, possible - begun_with_);
    if (!replicate) return false;
    series_->sums.add(*replicate);
    traced_ += series_->grid_rays;
    if (replicate->packets) {
      traced_ += replicate->packets->packets + replicate->packets->sky_rays;
      memory_.learn(ray_counts(work_), *replicate->packets);
    }
    direct_s_ += replicate->direct_s;
    indirect_s_ += replicate->indirect_s;
    hand_over();
    return true;
  }

  // Hands the result so far to the monitor.
  void hand_over() {
    if (!monitor_.wants_result || !monitor_.wants_result()) return;
    const bool use_fallback = fallback_ && series_->traced() < fallback_->traced();
    monitor_.receive_result(result_of_series(use_fallback ? *fallback_ : *series_, StopReason::interrupted));
  }

  // Without an indirect pass the host has almost nothing to do meanwhile, and saving memory is better.
  [[nodiscard]] std::size_t replicates_at_once() const {
    if (settings_.max_rays || !has_indirect()) return 1;
    const double asked = std::max(1, settings_.replicates_at_once);
    if (!settings_.memory_bytes) return static_cast<std::size_t>(asked);
    return static_cast<std::size_t>(std::clamp(*settings_.memory_bytes / replicate_bytes(work_), 1.0, asked));
  }

  [[nodiscard]] RayCounts ray_counts(const Work& work) const {
    return {model_.has_beam() ? work.rays : 0.0, static_cast<double>(sky_rays(work)), work.packets};
  }

  // Returns the memory of a replicate while it is made, in bytes.
  [[nodiscard]] double replicate_bytes(const Work& work) const {
    return maker_.sum_bytes() + (has_indirect() ? memory_.bytes(ray_counts(work)) : 0.0);
  }

  // Returns the largest number of packets in a replicate's first round that fits the memory. It depends on the machine
  // only if memory is too short for even a single comfortable replicate.
  [[nodiscard]] double most_packets(Work work) const {
    if (!settings_.memory_bytes) return most_first_packets;
    const double most_bytes = std::min(comfortable_bytes, *settings_.memory_bytes - maker_.sum_bytes());
    double fits = first_pilot_packets;
    double exceeds = most_first_packets;
    while (exceeds - fits > 1.0) {
      work.packets = std::floor(0.5 * (fits + exceeds));
      (memory_.bytes(ray_counts(work)) <= most_bytes ? fits : exceeds) = work.packets;
    }
    return fits;
  }

  // The two errors are empty for a pass without any light in the scene.
  [[nodiscard]] std::optional<JudgedError> direct_error(const RunSums& sums) const {
    if (!model_.has_beam()) return std::nullopt;
    return sunfleck::direct_error(sums, settings_.accuracy);
  }
  [[nodiscard]] std::optional<JudgedError> indirect_error(const RunSums& sums) const {
    if (!has_indirect()) return std::nullopt;
    return sunfleck::indirect_error(sums, settings_.accuracy);
  }
  [[nodiscard]] double direct_error() const { return direct_error(series_->sums).value_or(JudgedError{}).relative; }
  [[nodiscard]] double indirect_error() const { return indirect_error(series_->sums).value_or(JudgedError{}).relative; }

  [[nodiscard]] bool bounds_hold() const {
    return direct_error() <= settings_.accuracy.direct && indirect_error() <= settings_.accuracy.indirect;
  }

  void report_pilot() const {
    if (!monitor_.report) return;
    monitor_.report({.stage = Progress::Stage::pilot, .rays = traced_});
  }

  // `expected` is the number of replicates of the whole run, as far as is known now.
  void report(std::size_t expected) {
    if (!monitor_.report) return;
    const double direct = direct_error();
    const double indirect = indirect_error();
    const bool direct_lags = direct / settings_.accuracy.direct >= indirect / settings_.accuracy.indirect;
    Progress progress{.rays = traced_};
    progress.pass = direct_lags ? Progress::Pass::direct : Progress::Pass::indirect;
    progress.bound = direct_lags ? settings_.accuracy.direct : settings_.accuracy.indirect;
    if (!std::isnan(direct + indirect)) progress.relative_error = direct_lags ? direct : indirect;
    const auto done = static_cast<double>(series_->sums.replicates);
    const double each_s = (seconds() - begun_s_) / std::max(1.0, done - static_cast<double>(begun_with_));
    const double left = std::min(static_cast<double>(expected) - done, affordable_replicates(each_s));
    progress.fraction = completion_.update(done, done + left);
    progress.seconds_left = left * each_s;
    monitor_.report(progress);
  }

  // Returns how many more replicates the limits on time and rays allow.
  [[nodiscard]] double affordable_replicates(double seconds_each) const {
    double most = std::numeric_limits<double>::infinity();
    if (settings_.max_seconds) most = std::max(0.0, *settings_.max_seconds - seconds()) / std::max(seconds_each, 1e-9);
    if (settings_.max_rays && series_->sums.replicates > 0) {
      const auto traced = static_cast<double>(series_->traced());
      const double each = std::max(1.0, traced / static_cast<double>(series_->sums.replicates));
      most = std::min(most, std::floor(std::max(0.0, static_cast<double>(*settings_.max_rays) - traced) / each));
    }
    return most;
  }

  // Returns the number of replicates after which a run to its bounds is expected to end: at the second good check in a
  // row.
  [[nodiscard]] std::size_t expected_replicates() const {
    const std::size_t done = series_->sums.replicates;
    std::size_t needed = planned_replicates;
    if (done >= 2) {
      const auto needs = [&](double error, double bound) {
        return replicates_needed(error, bound, settings_.accuracy.confidence, done, most_replicates);
      };
      needed = std::max(needs(direct_error(), settings_.accuracy.direct), needs(indirect_error(), settings_.accuracy.indirect));
    }
    std::size_t check = next_check_;
    if (good_checks_ > 0 && needed <= check) return check;
    while (check < std::min(needed, most_replicates)) check = check_after(check);
    return check_after(check);
  }

  // Uses the earlier run as the pilot. Work for light that this scene has and the earlier one lacked starts as small as in
  // pilots.
  RadiationResult begin_as_told(Work work) {
    if (model_.has_beam()) work.rays = std::max(first_pilot_rays, work.rays);
    if (has_indirect()) work.packets = std::max(first_pilot_packets, work.packets);
    begin(work);
    return run_to_bound();
  }

  // Returns the work with which planned_replicates would just have reached the bounds, as far as this run shows.
  [[nodiscard]] Work next_work() const {
    Work next = work_;
    const std::size_t done = series_->sums.replicates;
    if (done < 2) return next;
    const double fewer = std::sqrt(static_cast<double>(done) / planned_replicates) *
                         t_quantile(settings_.accuracy.confidence, planned_replicates) /
                         t_quantile(settings_.accuracy.confidence, done);
    const auto scale = [&](double error, double bound, double slope) {
      return std::clamp(growth(error * fewer, bound, slope), 1.0 / trusted_refinement, trusted_refinement);
    };
    next.rays *= scale(direct_error(), settings_.accuracy.direct, ray_slope);
    next.packets *= scale(indirect_error(), settings_.accuracy.indirect, packet_slope);
    next.rays = std::min(next.rays, static_cast<double>(max_grid_rays));
    next.packets = std::min(next.packets, most_packets(next));
    return next;
  }

  [[nodiscard]] double grid_rays_asked(int replicates) const {
    return std::max(1.0, model_.plot.area_m2() / (*settings_.grid_m * *settings_.grid_m) / replicates);
  }

  // Returns the factor by which the work must grow for an error to fall to the part of its bound that is aimed at.
  [[nodiscard]] static double growth(double error, double bound, double slope) {
    return std::pow(error / (aimed_part_of_bound * bound), 1.0 / slope);
  }

  // Returns the work of a replicate such that `replicates` of them reach the bounds: pilots of the direct pass alone
  // determine the rays, then pilots with half those rays determine the packets. Returns nothing if stopped; the last pilot
  // is then kept as the fallback.
  std::optional<Work> choose_work(int replicates) {
    double most = static_cast<double>(max_grid_rays);
    if (settings_.max_rays) most = std::max(1.0, static_cast<double>(*settings_.max_rays) / (2.0 * pilot_replicates));
    Work work;
    if (settings_.grid_m) {
      work.rays = grid_rays_asked(replicates);
    } else if (model_.has_beam()) {
      const auto needed = [this](double fewer) { return growth(direct_error() * fewer, settings_.accuracy.direct, ray_slope); };
      const auto rays = grow_pilots(
          {std::min(first_pilot_rays, most), 0.0}, &Work::rays, [&] { return most; }, needed, replicates);
      if (!rays) return std::nullopt;
      work.rays = rays->chosen;
    }
    if (!has_indirect()) return work;
    // On a fixed grid there is at most one packet per ray, and at least as many packets as in the first pilot.
    if (settings_.grid_m) most = std::min(most, std::max(first_pilot_packets, work.rays));
    if (most <= first_pilot_packets) {
      work.packets = most;
      return work;
    }
    const Work pilot{std::max(std::min(first_pilot_rays, work.rays), 0.5 * work.rays), std::min(first_pilot_packets, most)};
    const auto needed = [this](double fewer) {
      return growth(indirect_error() * fewer, settings_.accuracy.indirect, packet_slope);
    };
    const auto packets = grow_pilots(
        pilot, &Work::packets, [&] { return std::min(most, most_packets(work)); }, needed, replicates);
    if (!packets) return std::nullopt;
    work.packets = packets->chosen;
    // More replicates make up for packets that do not fit the memory, and each of them then needs fewer rays.
    const bool held_back = !fixed() && packets->chosen == most_packets(work);
    if (held_back) work.rays *= std::pow(packets->wanted / packets->chosen, -0.5 / ray_slope);
    if (held_back && model_.has_beam()) work.rays = std::max(first_pilot_rays, work.rays);
    return work;
  }

  // A part of the work as the pilots request it, and as much of it as is possible.
  struct Part {
    double wanted = 0.0, chosen = 0.0;
  };

  // Runs pilots until one is large enough to forecast `part` of the work, which is at most `most()`. `needed` returns the
  // factor by which the pilot's part must grow.
  template <class Most, class Growth>
  std::optional<Part> grow_pilots(Work pilot, double Work::*part, const Most& most, const Growth& needed, int replicates) {
    const double fewer = std::sqrt(static_cast<double>(pilot_replicates) / replicates) *
                         t_quantile(settings_.accuracy.confidence, static_cast<std::size_t>(replicates)) /
                         t_quantile(settings_.accuracy.confidence, pilot_replicates);
    while (true) {
      const double before = seconds();
      begin(pilot, pilot_stream);
      while (series_->sums.replicates < pilot_replicates) {
        if (!add_replicate(pilot_replicates, pilot_replicates)) {
          keep_fallback();
          return std::nullopt;
        }
        report_pilot();
      }
      const double wanted = pilot.*part * std::max(0.25, needed(fewer));
      const double possible = std::min(wanted, most());
      const double affordable = pilot.*part * affordable_growth((seconds() - before) / pilot_replicates);
      if (affordable < possible) fitted_to_time_ = true;
      const double next = std::max(1.0, std::min(possible, affordable));
      keep_fallback();
      if (next <= trusted_refinement * pilot.*part || next < wanted) return Part{wanted, next};
      pilot.*part *= trusted_refinement;
    }
  }

  // With a limit on time, replicates must be small enough for pilot_replicates of them to be done in time.
  [[nodiscard]] double affordable_growth(double seconds_per_replicate) const {
    if (!settings_.max_seconds || !settings_.fit_to_time) return std::numeric_limits<double>::infinity();
    const double left = std::max(0.0, *settings_.max_seconds - seconds());
    return left / (2.0 * pilot_replicates * std::max(seconds_per_replicate, 1e-6));
  }

  void keep_fallback() {
    if (series_ && series_->sums.replicates >= 2) {
      fallback_ = std::move(series_);
    }
    series_.reset();
  }

  RadiationResult go_on(const SolveState& state, int replicates) {
    begin(state.work, state.replicates());
    ENSURE(restore(series_->sums, state.sums), ==, true);
    begun_with_ = series_->sums.replicates;
    traced_ = series_->traced();
    next_check_ = state.next_check;
    good_checks_ = state.good_checks;
    return fixed() ? run_fixed(replicates) : run_to_bound();
  }

  RadiationResult run_fixed(int replicates) {
    const auto all = static_cast<std::size_t>(replicates);
    while (series_->sums.replicates < all) {
      if (spent() || !add_replicate(all, all)) return finish(stop_);
      report(all);
      if (monitor_.wants_state && monitor_.wants_state()) keep_state();
    }
    return finish(StopReason::work_done);
  }

  RadiationResult run_to_bound() {
    while (true) {
      // The run cannot end before the next check, nor at it if it were the first good one.
      const std::size_t certain = good_checks_ == 0 ? check_after(next_check_) : next_check_;
      if (spent() || !add_replicate(certain, most_replicates)) return finish(stop_);
      report(expected_replicates());
      if (series_->sums.replicates >= next_check_) {
        good_checks_ = bounds_hold() ? good_checks_ + 1 : 0;
        if (good_checks_ == 2) return finish(StopReason::bound_reached);
        if (series_->sums.replicates >= most_replicates) return finish(StopReason::replicates_spent);
        next_check_ = check_after(next_check_);
      }
      if (monitor_.wants_state && monitor_.wants_state()) keep_state();
    }
  }

  [[nodiscard]] static std::size_t check_after(std::size_t check) {
    return std::min(most_replicates, check + std::max<std::size_t>(4, check / 8));
  }

  void keep_state() const {
    if (!monitor_.receive_state || series_->sums.replicates < 2 || fitted_to_time_) return;
    monitor_.receive_state({work_, next_check_, good_checks_, plain_sums(series_->sums)});
  }

  // Returns true if the next replicate would need more rays than are left.
  bool spent() {
    if (!settings_.max_rays) return false;
    const std::size_t done = series_->sums.replicates;
    const std::uint64_t run = series_->traced();
    const std::uint64_t next = done > 0 ? run / done : series_->grid_rays;
    if (run + next <= *settings_.max_rays) return false;
    stop_ = StopReason::rays_spent;
    return true;
  }

  RadiationResult finish(StopReason reason) {
    queue_.end();
    const bool stopped = reason != StopReason::bound_reached && reason != StopReason::work_done;
    if (stopped && series_) keep_state();
    const bool use_fallback = fallback_ && (!series_ || series_->sums.replicates < 2);
    if (use_fallback) {
      series_ = std::move(fallback_);
    } else if (!series_) {
      begin({first_pilot_rays, first_pilot_packets});
    }
    RadiationResult result = result_of_series(*series_, reason);
    result.work = work_;
    result.next_work = next_work();
    return result;
  }

  [[nodiscard]] RadiationResult result_of_series(const Series& series, StopReason reason) const {
    RadiationResult result = result_of(series.sums, settings_.accuracy.confidence);
    result.stop = reason;
    result.direct.replicates = series.sums.replicates;
    result.direct.rays = series.sums.replicates * series.grid_rays;
    if (result.direct.rays > 0) {
      result.direct.grid_m = std::sqrt(model_.plot.area_m2() / static_cast<double>(result.direct.rays));
    }
    const auto tell = [](const std::optional<JudgedError>& error, auto& summary) {
      if (!error || std::isnan(error->relative)) return;
      summary.relative_error = error->relative;
      summary.judged = error->figure;
    };
    tell(direct_error(series.sums), result.direct);
    tell(indirect_error(series.sums), result.indirect);
    if (!model_.has_beam()) result.direct.relative_error = 0.0;
    // Replicates overlap, so the elapsed time is divided in proportion to the time spent in each pass.
    const double busy_s = direct_s_ + indirect_s_;
    result.indirect.seconds = busy_s > 0.0 ? seconds() * indirect_s_ / busy_s : 0.0;
    result.direct.seconds = seconds() - result.indirect.seconds;
    if (!fixed()) {
      result.direct.bound = settings_.accuracy.direct;
      if (has_indirect()) result.indirect.bound = settings_.accuracy.indirect;
    }
    return result;
  }

  const RadiationModel& model_;
  const SolveSettings& settings_;
  const Monitor& monitor_;
  ReplicateMaker maker_;
  PacketMemory memory_;
  double start_s_ = clock_s();
  std::unique_ptr<Series> series_, fallback_;
  std::mutex stop_mutex_;
  StopReason stop_ = StopReason::interrupted;
  Work work_;
  bool fitted_to_time_ = false;  // the work was limited by max_seconds
  std::uint64_t traced_ = 0;
  std::size_t next_check_ = first_check, good_checks_ = 0;
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
  return Solver(model, layout, tracer, settings, monitor, nullptr).forecast();
}

RadiationResult solve(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer, const SolveSettings& settings,
                      const Monitor& monitor, ReplicateHelpers* helpers) {
  if (is_dark(model)) return dark_result(model, layout, settings);
  return Solver(model, layout, tracer, settings, monitor, helpers).run();
}

}  // namespace sunfleck

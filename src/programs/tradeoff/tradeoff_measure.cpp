#include "programs/tradeoff/tradeoff_measure.h"

#include "base/file.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "base/units.h"
#include "programs/tradeoff/coarse_mesh.h"
#include "programs/tradeoff/tradeoff_error.h"
#include "programs/tradeoff/tradeoff_fit.h"
#include "programs/tradeoff/tradeoff_plan.h"
#include "simulate/interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// The measured bounds start here and are halved at least `least_bounds` times, until one meets the required error, but not
// where runs would need more than this share of the reference's rays or packets. Halving the bound takes four times the packets
// (errors fall with the square root of their number) and, since their errors fall faster, fewer than four times the rays.
constexpr double widest_bound = 0.02;
constexpr std::size_t least_bounds = 3, most_bounds = 10;
constexpr double growth_per_bound = 4.0;
constexpr double most_of_reference = 1.0;
// The light of triangles takes a run as long as about that many rays for each of them.
constexpr double rays_per_triangle = 10.0;
// Offset of the seeds of the reference's parts, which keeps them apart from those of the runs.
constexpr std::uint64_t reference_seed = std::uint64_t{1} << 40U;

enum class Light { direct, indirect, absorbed };

class TradeoffMeasurement {
 public:
  TradeoffMeasurement(const TradeoffOptions& options, const SolveSettings& settings, Simulation& simulation,
                      TradeoffReport& report, const std::filesystem::path& table)
      : options_(options),
        settings_(settings),
        all_light_(simulation),
        direct_light_(simulation.with_model(direct_light_model(simulation.model()))),
        plan_(plan_tradeoff(simulation.model(), options.finest_rays, options.run.grid_m)),
        report_(report),
        table_(table) {
    foresee();
  }

  // Runs all measurements. Returns false if stopped before the end.
  bool run() {
    if (!measure_references()) return false;
    for (std::size_t k = 0; k < plan_.grids_m.size(); ++k) {
      const SolveSettings settings = grid_settings(settings_, plan_.grids_m[k]);
      const int seeds = seeds_of(plan_.grids_m, k);
      if (!measure({TradeoffSeries::grids, plan_.grids_m[k], {}}, direct_light_, settings, seeds)) return false;
    }
    for (std::size_t k = 0; k < plan_.packets.size(); ++k) {
      const SolveSettings settings = packet_settings(settings_, all_light_.model(), plan_.packets[k]);
      const int seeds = seeds_of(plan_.packets, k);
      if (!measure({TradeoffSeries::packets, plan_.packets[k], {}}, all_light_, settings, seeds)) return false;
    }
    if (!measure_bounds()) return false;
    return std::all_of(options_.meshes.begin(), options_.meshes.end(), [this](double share) { return measure_mesh(share); });
  }

 private:
  // Adds up the work of all runs, of which those to bounds are a guess.
  void foresee() {
    const auto add = [&](int runs, double rays) { foreseen_ += runs * (rays + work_beside_rays()); };
    const double rays_of_part = reference_rays() / reference_parts, packets_of_part = reference_packets() / reference_parts;
    add(reference_parts, rays_of_part + packets_of_part);
    if (!plan_.grids_m.empty()) add(reference_parts, rays_of_part);
    for (std::size_t k = 0; k < plan_.grids_m.size(); ++k)
      add(seeds_of(plan_.grids_m, k), all_light_.model().plot.area_m2() / (plan_.grids_m[k] * plan_.grids_m[k]));
    for (std::size_t k = 0; k < plan_.packets.size(); ++k)
      add(seeds_of(plan_.packets, k), 2.0 * tradeoff_replicates * plan_.packets[k]);
    add(options_.seeds * static_cast<int>(least_bounds), rays_of_part + packets_of_part);
  }
  // Returns the number of runs of a setting of the plan; cheap settings have more.
  [[nodiscard]] int seeds_of(const std::vector<double>& settings, std::size_t k) const {
    return options_.seeds * seeds_factor(settings.size() - 1 - k);
  }
  // Returns what a run does beside tracing, the light of triangles, in rays.
  [[nodiscard]] double work_beside_rays() const {
    return rays_per_triangle * static_cast<double>(all_light_.model().canopy.size());
  }

  [[nodiscard]] double reference_rays() const {
    return reference_parts * all_light_.model().plot.area_m2() / (plan_.reference_grid_m * plan_.reference_grid_m);
  }
  [[nodiscard]] double reference_packets() const { return reference_parts * tradeoff_replicates * plan_.reference_packets; }

  [[nodiscard]] bool stop() const {
    return interrupted() || (options_.run.max_seconds && since_start_.seconds() >= *options_.run.max_seconds);
  }

  struct Simulated {
    RadiationResult result;
    double seconds = 0.0;
    [[nodiscard]] std::uint64_t rays() const { return result.direct.rays + result.indirect.sky_rays + result.indirect.packets; }
  };

  // Runs one simulation. Returns none if stopped.
  std::optional<Simulated> simulate(Simulation& simulation, SolveSettings settings, std::uint64_t seed) {
    if (stop()) return {};
    settings.seed = seed;
    Monitor monitor;
    monitor.interrupted = [this] { return stop(); };
    monitor.report = [this](const Progress& state) {
      const double fraction = (work_ + static_cast<double>(state.rays)) / foreseen_;
      progress_.update({.rays = rays_ + state.rays, .fraction = std::min(0.99, fraction)});
    };
    Stopwatch watch;
    Simulated run{simulation.solve(settings, monitor)};
    run.seconds = watch.lap();
    if (run.result.stop == StopReason::interrupted) return {};
    rays_ += run.rays();
    work_ += static_cast<double>(run.rays()) + work_beside_rays();
    return run;
  }

  [[nodiscard]] TradeoffReference& reference(Light light) { return references_[static_cast<std::size_t>(light)]; }

  static Light light_of(TradeoffSeries series) {
    return series == TradeoffSeries::grids     ? Light::direct
           : series == TradeoffSeries::packets ? Light::indirect
                                               : Light::absorbed;
  }

  static RunValues values_of(Light light, const RadiationModel& model, const RadiationResult& result) {
    return light == Light::indirect ? indirect_values(model, result) : absorbed_values(model, result);
  }

  bool measure_references() {
    say(fmt::format("reference: {:.3g} rays{}", reference_rays(),
                    plan_.packets.empty() ? std::string() : fmt::format(", {:.3g} packets", reference_packets())));
    std::vector<double> incident;
    for (std::uint64_t part = 0; part < reference_parts; ++part) {
      const std::optional<Simulated> full =
          simulate(all_light_, reference_settings(settings_, plan_), options_.run.seed + reference_seed + part);
      if (!full) return false;
      incident = incident_w_m2(full->result);
      reference(Light::absorbed).add(absorbed_values(all_light_.model(), full->result));
      count_reference(TradeoffSeries::bounds, full->rays());
      if (!plan_.packets.empty()) {
        reference(Light::indirect).add(indirect_values(all_light_.model(), full->result));
        count_reference(TradeoffSeries::packets, full->rays());
      }
      if (plan_.grids_m.empty()) continue;
      const std::optional<Simulated> direct =
          simulate(direct_light_, grid_settings(settings_, plan_.reference_grid_m), options_.run.seed + reference_seed + part);
      if (!direct) return false;
      reference(Light::direct).add(absorbed_values(direct_light_.model(), direct->result));
      count_reference(TradeoffSeries::grids, direct->rays());
    }
    if (!plan_.grids_m.empty()) judge(TradeoffSeries::grids, direct_light_.model(), {1.0});
    if (!plan_.packets.empty()) judge(TradeoffSeries::packets, all_light_.model(), incident);
    judge(TradeoffSeries::bounds, all_light_.model(), incident);
    return true;
  }

  void count_reference(TradeoffSeries series, std::uint64_t rays) {
    report_.reference_rays[static_cast<std::size_t>(series)] += rays;
  }

  void judge(TradeoffSeries series, const RadiationModel& model, const std::vector<double>& incident) {
    TradeoffReference& truth = reference(light_of(series));
    truth.judge_by(make_norms(model, truth.values(), incident));
    for (const Quantity quantity : quantities) {
      report_.reference_error[static_cast<std::size_t>(series)][static_cast<std::size_t>(quantity)] = truth.own_error(quantity);
    }
  }

  // Runs a setting with all its seeds, and stores what it shows in the report and on disk. Returns false if stopped meanwhile.
  bool measure(TradeoffLevel level, Simulation& simulation, const SolveSettings& settings, int seeds) {
    const Light light = light_of(level.series);
    const TradeoffReference& truth = reference(light);
    TradeoffReference found_by_runs;
    bool whole = true;
    for (int i = 0; i < seeds && whole; ++i) {
      const std::uint64_t seed = options_.run.seed + static_cast<std::uint64_t>(i);
      const std::optional<Simulated> run = simulate(simulation, settings, seed);
      whole = run.has_value();
      if (!run) break;
      const RunValues values = values_of(light, simulation.model(), run->result);
      TradeoffRun found{seed, run->seconds, run->rays(), {}};
      for (const Quantity quantity : quantities) {
        const std::size_t q = static_cast<std::size_t>(quantity);
        found.errors[q] = quantity == Quantity::triangle && level.series == TradeoffSeries::meshes
                              ? QuantityError{no_value, no_value, no_value, no_value}
                              : truth.error(quantity, values[q], settings_.accuracy.confidence, run->result.direct.replicates);
      }
      level.runs.push_back(found);
      found_by_runs.add(values);
      last_direct_ = run->result.direct.rays;
      last_indirect_ = run->result.indirect.sky_rays + run->result.indirect.packets;
    }
    if (level.runs.empty()) return false;
    keep(std::move(level), truth, found_by_runs);
    return whole;
  }

  void keep(TradeoffLevel level, const TradeoffReference& truth, const TradeoffReference& found_by_runs) {
    std::string line =
        fmt::format("{}: {:.3g} rays, {:.2g} s, error", setting_name(level), mean_rays(level), median_seconds(level));
    for (const Quantity quantity : quantities) {
      const std::size_t q = static_cast<std::size_t>(quantity);
      std::vector<double> errors;
      for (const TradeoffRun& run : level.runs) errors.push_back(run.errors[q].true_error);
      // Single triangles are estimated with a bias, and the light of a coarser mesh is another.
      const bool unbiased = quantity != Quantity::triangle && level.series != TradeoffSeries::meshes;
      const bool resolved = !unbiased || truth.resolves(found_by_runs, quantity);
      level.error[q] = resolved ? typical_error(errors, truth.own_error(quantity)) : no_value;
      if (std::isfinite(level.error[q])) line += fmt::format(", {} {:.2g}", quantity_name(quantity), level.error[q]);
    }
    say(line);
    report_.levels.push_back(std::move(level));
    write_file(table_, tradeoff_csv(report_));
  }

  bool measure_bounds() {
    double bound = widest_bound;
    for (std::size_t k = 0; k < most_bounds; ++k, bound *= 0.5) {
      SolveSettings settings = settings_;
      settings.accuracy.direct = settings.accuracy.indirect = bound;
      const double expected = growth_per_bound * static_cast<double>(last_direct_ + last_indirect_) + work_beside_rays();
      foreseen_ = std::max(foreseen_, work_ + options_.seeds * expected);
      if (!measure({TradeoffSeries::bounds, bound, {}}, all_light_, settings, options_.seeds)) return false;
      finest_bound_ = bound;
      const double most = most_of_reference / growth_per_bound;
      const bool reference_too_coarse = static_cast<double>(last_direct_) > most * reference_rays() ||
                                        static_cast<double>(last_indirect_) > most * reference_packets();
      if (k + 1 < least_bounds) continue;
      if (reference_too_coarse) break;
      const auto found = recommend(report_.levels, options_.requested_error, requested_quantity(options_));
      if (found && !found->extrapolated) break;
    }
    return true;
  }

  // Measures the finest bound on a coarser mesh, so that its error is the error of the mesh.
  bool measure_mesh(double share) {
    if (stop()) return false;
    RadiationModel model = all_light_.model();
    model.canopy = coarsened(all_light_.model().canopy, share);
    const double kept = static_cast<double>(model.canopy.size()) /
                        static_cast<double>(std::max<std::size_t>(1, all_light_.model().canopy.size()));
    say(fmt::format("mesh {:g}: {} triangles, {:.3g} of the original", share, model.canopy.size(), kept));
    Scene scene;
    scene.model = std::move(model);
    Simulation coarse(std::move(scene), options_.run);
    SolveSettings settings = settings_;
    settings.accuracy.direct = settings.accuracy.indirect = finest_bound_;
    return measure({TradeoffSeries::meshes, share, {}}, coarse, settings, options_.seeds);
  }

  const TradeoffOptions& options_;
  const SolveSettings& settings_;
  Simulation& all_light_;
  Simulation direct_light_;
  const TradeoffPlan plan_;
  TradeoffReport& report_;
  const std::filesystem::path& table_;
  std::array<TradeoffReference, 3> references_;  // [light]
  const Stopwatch since_start_;
  double foreseen_ = 0.0;  // rays and packets, and other work in rays, as far as can be predicted
  double work_ = 0.0;      // the part of it that is done
  std::uint64_t rays_ = 0, last_direct_ = 0, last_indirect_ = 0;
  double finest_bound_ = widest_bound;
  ProgressLine progress_{"measuring"};
};

}  // namespace

Quantity requested_quantity(const TradeoffOptions& options) {
  return *std::find_if(quantities.begin(), quantities.end(),
                       [&](Quantity quantity) { return options.quantity == quantity_name(quantity); });
}

bool measure_tradeoff(const TradeoffOptions& options, const SolveSettings& settings, Simulation& simulation,
                      const std::filesystem::path& table, TradeoffReport& report) {
  return TradeoffMeasurement(options, settings, simulation, report, table).run();
}

}  // namespace sunfleck

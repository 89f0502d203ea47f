#pragma once
// The work of one replicate: as much as brings a run just to its bounds, which pilots show, within its limits on rays, time
// and memory.

#include "physics/transport/indirect/packet_memory.h"
#include "physics/transport/indirect/replicate_maker.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/solve.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// Number of replicates for which the work is chosen, and in a series of pilots. Errors that are known from few replicates are
// uncertain (by 18 % from 16 of them), and a pass that gets more work than it needs wastes it: many small pilots forecast
// better than few large ones.
inline constexpr int planned_replicates = 16;
inline constexpr int pilot_replicates = 16;
// The smallest work of pilots, and the number of them that may show that they are far too small.
inline constexpr Work first_pilot{4096, 2048};
inline constexpr int glanced_pilots = 8;

// What a series of replicates showed.
struct SeriesOutcome {
  std::size_t replicates = 0;
  double direct_error = 0.0, indirect_error = 0.0;  // compared with the bounds; 0 without such light
  double seconds_each = 0.0;
  double seconds_left = 0.0;  // of max_seconds
  double rays_each = 0.0;     // rays of a replicate: those of the beam and the sky, and the packets of all rounds
};

class WorkPlanner {
 public:
  // Makes pilot_replicates of that work, or glanced_pilots if these are far_too_small(); returns nothing if stopped.
  using RunPilots = std::function<std::optional<SeriesOutcome>(const Work&)>;

  // All arguments must outlive the planner.
  WorkPlanner(const RadiationModel& model, const SolveSettings& settings, const ReplicateMaker& maker)
      : model_(model),
        settings_(settings),
        maker_(maker),
        memory_(model, maker.lights().size()),
        has_beam_(any_beam(maker.lights())) {}

  // Returns true if the settings give the work, so that no error ends the run.
  [[nodiscard]] bool fixed() const { return settings_.grid_m || settings_.passes; }
  [[nodiscard]] int asked_replicates() const;

  // Returns the work of the run's replicates, after pilots if they are needed; nothing if stopped.
  [[nodiscard]] std::optional<Work> choose(const RunPilots& run_pilots);

  // Returns true if pilots that showed this will be followed by larger ones, whatever more of them would show.
  [[nodiscard]] bool far_too_small(const SeriesOutcome& pilots) const;

  // Returns the work for a run that uses an earlier one as its pilot. Work for light that this scene has and the earlier one
  // lacked starts as small as in pilots.
  [[nodiscard]] Work begin_with(Work earlier) const;

  // Returns the part of the work's rays that each light needs, [light], if lights with these rays had these errors: 1 for the light
  // that needs most. Lights that are not judged do not count as such, and need no more than it.
  [[nodiscard]] std::vector<double> ray_needs(std::span<const double> rays, std::span<const SeriesOutcome> lights,
                                              const std::vector<bool>& judged) const;

  // Returns the shares of the rays that lights with these needs get in pilots, [light].
  [[nodiscard]] std::vector<double> ray_shares(std::span<const double> needs) const;
  // Returns their shares in the run. Adds rays to the work where they cost little beside the packets that all lights share: what
  // pilots forecast of a beam is uncertain, and one that lags behind costs replicates with all of their packets.
  [[nodiscard]] std::vector<double> spare_rays(std::span<const double> needs, Work& work) const;

  // Returns the work with which planned_replicates would just have reached the bounds, as far as this run shows.
  [[nodiscard]] Work next(const Work& work, const SeriesOutcome& run) const;

  [[nodiscard]] std::size_t sky_rays(const Work& work) const;
  // Returns the largest number of beam rays from whose landings packets start.
  [[nodiscard]] double sampled_rays(const Work& work) const;
  // Returns the number of replicates to make at the same time in this process.
  [[nodiscard]] std::size_t at_once(const Work& work) const;
  // Returns the memory of a replicate while it is made, in bytes.
  [[nodiscard]] double replicate_bytes(const Work& work) const;
  // Return the parts of it that its sums by place take, and where its beam rays landed.
  [[nodiscard]] PlaceBytes place_bytes(const Work& work) const;
  [[nodiscard]] double record_bytes(const Work& work) const;
  // Records the memory that a replicate took.
  void learn(const Work& work, const IndirectSums& packets) { memory_.learn(ray_counts(work), packets); }

  // Returns true if the chosen work was limited by max_seconds.
  [[nodiscard]] bool fitted_to_time() const { return fitted_to_time_; }

 private:
  // Returns whether the work is chosen for a bound that holds for each organ.
  [[nodiscard]] bool for_organs() const { return settings_.accuracy.of == ErrorTarget::organ && !fixed(); }
  // A part of the work as the pilots request it, and as much of it as is possible.
  struct Part {
    double wanted = 0.0, chosen = 0.0;
  };

  [[nodiscard]] std::optional<Work> choose_by_pilots(const RunPilots& run_pilots);
  [[nodiscard]] Part forecast(double pilot, double growth, double affordable_growth, double most);
  [[nodiscard]] double rays_within_limit() const;
  void fit_to_rays(const Work& pilot, double rays_of_pilot, Part& rays, Part& packets) const;
  [[nodiscard]] Work balanced(const Part& rays, const Part& packets) const;
  // Returns the work with more rays where packets would start from too few landings.
  [[nodiscard]] Work with_enough_rays(Work work) const;
  [[nodiscard]] double ray_growth(const SeriesOutcome& series, int replicates) const;
  [[nodiscard]] double packet_growth(const SeriesOutcome& series, int replicates) const;
  [[nodiscard]] double affordable_growth(const SeriesOutcome& pilots) const;
  [[nodiscard]] double grid_rays_asked() const;
  [[nodiscard]] double most_packets(Work work) const;
  [[nodiscard]] RayCounts ray_counts(const Work& work) const;

  const RadiationModel& model_;
  const SolveSettings& settings_;
  const ReplicateMaker& maker_;
  PacketMemory memory_;
  bool has_beam_;  // in any of the lights
  bool fitted_to_time_ = false;
};

}  // namespace sunfleck

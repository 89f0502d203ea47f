#pragma once
// The whole simulation: equal, independent replicates, each with a direct pass and the rounds of an indirect pass, until the
// requested errors are reached.

#include "physics/transport/indirect/place_sums.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/beam_block.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/solve/solve_state.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace sunfleck {

class ReplicateHelpers;

// Number of replicates of a run with a fixed grid if it is not given.
inline constexpr int fixed_grid_replicates = 16;

struct SolveSettings {
  Accuracy accuracy;
  std::uint64_t seed = 1;
  std::optional<double> grid_m;  // fixed work: spacing of all beam rays of the run together
  std::optional<int> passes;     // fixed work: exactly this many replicates, at least 8
  // Work to start with instead of running pilots: next_work of a run on a very similar scene. [light]; empty: pilots
  std::vector<Work> begin_with;
  std::optional<double> packets;          // fixed work, with grid_m: packets in the first round of each replicate
  std::optional<std::uint64_t> max_rays;  // rays and packets; no replicate is begun that would exceed it
  std::optional<double> max_seconds;      // wall time of the simulation
  // With max_seconds, replicates are made so small that enough of them are done in time. Their work then depends on the
  // speed of the machine, and such a run has no state: a run resumed from it would end in different bytes each time.
  bool fit_to_time = true;
  ElementErrors element_errors = ElementErrors::skip;
  ShadeGroups shade_groups = ShadeGroups::all;
  // Largest number of replicates made at the same time, in this process and by each worker, if there is an indirect pass and no
  // max_rays; memory_bytes and software Vulkan may allow fewer.
  int replicates_at_once = 2;
  std::optional<double> memory_bytes;       // limit for all replicates being made; empty: no limit
  const SolveState* resume_from = nullptr;  // state of an interrupted run with the same settings; null starts a new run
};

struct Progress {
  // Pilots choose the work; nothing of the run is done before they end. Sensors with a bound are measured after the run.
  enum class Stage { pilot, run, sensors };
  enum class Pass { direct, indirect, sensors };

  Stage stage = Stage::run;
  std::uint64_t rays = 0;                // rays and packets, including the pilots'
  double fraction = 0.0;                 // completed part of the run; never falls, and reaches 1 only at the end
  std::optional<double> seconds_left;    // estimate; empty while there is none
  Pass pass = Pass::direct;              // the one that is further from its bound
  std::optional<double> relative_error;  // of that pass
  std::optional<double> bound;           // of that pass; empty for pilots and for fixed work
};

// Returns "direct", "indirect" or "sensors".
[[nodiscard]] constexpr std::string_view pass_name(Progress::Pass pass) {
  if (pass == Progress::Pass::sensors) return "sensors";
  return pass == Progress::Pass::direct ? "direct" : "indirect";
}

// The functions by which a caller watches and stops a run. All may be empty.
struct Monitor {
  std::function<void(const Progress&)> report;
  StopQuestion interrupted;  // called by several threads, one at a time
  // Called after each replicate, including those of pilots. If it returns true, the result so far is handed over: the
  // replicates of the run, or those of the last pilot while the run has traced less than that pilot. Its `stop` is
  // `interrupted`. Errors are NaN after a single replicate.
  std::function<bool()> wants_result;
  std::function<void(RadiationResult)> receive_result;
  // Called after each replicate except those of pilots. If it returns true the state is handed over; at the end of a
  // stopped run it is handed over in any case. There is no state before the second replicate, nor for a run whose work was
  // fitted to max_seconds.
  std::function<bool()> wants_state;
  std::function<void(const SolveStateView&)> receive_state;
  std::function<double()> clock_s;  // called by several threads; empty: the steady clock

  [[nodiscard]] bool is_interrupted() const { return interrupted && interrupted(); }
};

// The work of a run as its pilots forecast it.
struct RunForecast {
  Work work;                     // of one replicate
  double replicate_bytes = 0.0;  // memory of one replicate while it is made
  PlaceBytes place_bytes;        // the part of it that its sums by place take
  std::size_t at_once = 1;       // replicates made at the same time
};

// Runs only the pilots of `solve` and returns their forecast of a run with these settings; nothing if stopped.
[[nodiscard]] std::optional<RunForecast> forecast(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                                  const SolveSettings& settings, const Monitor& monitor);

// Runs the simulation. With helpers, unless there is a max_rays, workers make replicates too, and the result is the same. A
// run that is stopped before its second replicate is done falls back on the replicates of its pilot, if it had one. Throws
// Error (failure) if the ledger of any band does not close or if rays and landings do not match, and whatever the helpers
// throw.
[[nodiscard]] RadiationResult solve(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                    const SolveSettings& settings, const Monitor& monitor, ReplicateHelpers* helpers = nullptr);

// What a simulation of several lights found besides their results.
struct SharedOutcome {
  StopReason stop = StopReason::work_done;
  std::vector<JointErrors> sum_errors;  // [sum]
};

// Receives the result of a light.
using TakeLight = std::function<void(std::size_t light, RadiationResult result, const SharedOutcome& outcome)>;

// Runs one simulation of several lights, none of which may be dark, unless there is only one. They share its packets; each has
// beam rays of its own, as many as its error needs. The bounds hold for every light with at least 1 % of the brightest light's
// flux. Hands the results over one after the other when all replicates are made, so that they need not lie in memory together;
// hands nothing over if several lights were interrupted. The monitor's results are for single lights only. Throws as `solve`
// does.
[[nodiscard]] SharedOutcome solve_lights(Lights lights, const CounterLayout& layout, Tracer& tracer,
                                         const SolveSettings& settings, const Monitor& monitor, ReplicateHelpers* helpers,
                                         const WantedSums& sums, const TakeLight& take);

}  // namespace sunfleck

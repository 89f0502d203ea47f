#pragma once
// The whole simulation: equal, independent replicates, each a direct pass and the rounds of its indirect pass, until the asked
// errors are reached.

#include "transport/accuracy.h"
#include "transport/beam_block.h"
#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/solve_state.h"
#include "transport/tracer.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace sunfleck {

class ReplicateHelpers;

// Replicates of a run whose grid is fixed, but not their number.
inline constexpr int fixed_grid_replicates = 16;

struct SolveSettings {
  Accuracy accuracy;
  std::uint64_t seed = 1;
  std::optional<double> grid_m;           // fixed work: spacing of all beam rays of the run together
  std::optional<int> passes;              // fixed work: so many replicates, >= 8
  std::optional<Work> begin_with;         // instead of what pilots would choose: next_work of a run on a scene much like this
  std::optional<double> packets;          // fixed work, beside grid_m: packets in the first round of each replicate
  std::optional<std::uint64_t> max_rays;  // no replicate is begun that would exceed it; rays and packets count
  std::optional<double> max_seconds;      // wall time of the simulation
  // With a max_seconds, replicates are made so small that enough of them are done in time. Their work then depends on how fast
  // the machine is, and such a run has no state: one that went on from it would end in other bytes each time.
  bool fit_to_time = true;
  ElementErrors element_errors = ElementErrors::skip;
  int replicates_at_once = 2;              // in the making side by side, where there is an indirect pass and no max_rays
  std::optional<double> memory_bytes;      // most that replicates in the making may take together; none: no bound
  const SolveState* go_on_from = nullptr;  // of a run with the same settings; null: from the beginning
};

struct Progress {
  enum class Stage { pilot, run };  // pilots choose the work; nothing of the run is done before they end
  enum class Pass { direct, indirect };

  Stage stage = Stage::run;
  std::uint64_t rays = 0;                // and packets, pilots' included
  double fraction = 0.0;                 // of the run; never falls, and reaches 1 only when all is done
  std::optional<double> seconds_left;    // as far as is known now; none while nothing is
  Pass pass = Pass::direct;              // the one that is further from its bound
  std::optional<double> relative_error;  // of that pass
  double bound = 0.0;                    // of that pass
};

// How a caller watches and ends a run. All may be empty.
struct Monitor {
  std::function<void(const Progress&)> report;
  StopQuestion interrupted;  // asked by several threads, one at a time
  // Asked after each replicate, pilots' too; what is known by then is handed over if the answer is yes: the replicates so far,
  // or the last pilot's while those have fewer rays and packets. Its `stop` is interrupted. Errors are NaN after a single one.
  std::function<bool()> wants_result;
  std::function<void(RadiationResult)> receive_result;
  // Asked after each replicate but the pilots'; the state is handed over if the answer is yes, and at the end of a run that
  // was stopped. From the second replicate on, and not of a run whose work was fitted to a max_seconds.
  std::function<bool()> wants_state;
  std::function<void(const SolveState&)> receive_state;
  std::function<double()> clock_s;  // asked by several threads; empty: the steady clock
};

// What a run will be made of, as its pilots tell.
struct RunForecast {
  Work work;                     // of a replicate
  double replicate_bytes = 0.0;  // memory of one in the making
  std::size_t at_once = 1;       // in the making side by side
};

// Runs the pilots of `solve` alone, and returns what they foretell of its run with these settings; none if stopped.
[[nodiscard]] std::optional<RunForecast> forecast(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                                  const SolveSettings& settings, const Monitor& monitor);

// Runs the simulation; with helpers, unless there is a max_rays, they make replicates too, and the result is the same. A run
// stopped before its second replicate is done falls back on the replicates of its pilot, if it had one. Throws Error (failure)
// if the ledger of any band does not close, or rays and landings do not tally, and what helpers throw.
[[nodiscard]] RadiationResult solve(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                    const SolveSettings& settings, const Monitor& monitor, ReplicateHelpers* helpers = nullptr);

}  // namespace sunfleck

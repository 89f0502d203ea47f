#pragma once
// The steps of a day or of several, simulated one after the other with one tree.
//
// Step n, from 0, has the seed RandomStream(seed, n).word(). Its replicates begin as large as the last simulated step's would
// now be chosen (RadiationResult::next_work), which is stored with the step: a day that was stopped anywhere and is resumed
// gives the same bytes as one that was not.

#include "io/day_summary.h"
#include "io/scene_reader.h"
#include "io/step_store.h"
#include "simulate/day_plan.h"
#include "simulate/requests.h"
#include "simulate/simulation.h"
#include "transport/solve.h"

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace sunfleck {

// Where the steps of a day go, and where steps that were done earlier come from.
class DaySink {
 public:
  virtual ~DaySink() = default;
  // Returns a step by day that was simulated earlier; empty: it is to be simulated.
  [[nodiscard]] virtual std::optional<StoredStep> find(std::size_t step) = 0;
  // Takes a step that was just simulated; all but its fields is used afterwards.
  virtual void take(std::size_t step, StoredStep& simulated) = 0;
};

struct SimulatedDay {
  std::vector<StepLight> lights;  // [step]; fewer than the plan has if the day was stopped
  DayTotals totals;
};

// Returns the solver's settings for the steps: without a limit of time, which ends a day between rays and not by smaller
// replicates, so that its bytes do not depend on the clock.
[[nodiscard]] SolveSettings day_solve_settings(const WorkRequest& work, const Scene& scene, int threads);

// Returns everything that the bytes of a finished step depend on.
[[nodiscard]] nlohmann::ordered_json day_settings(const DayRequest& request, const Scene& scene, const SolveSettings& settings,
                                                  const DayPlan& plan);

// Puts a model under the light of a moment.
void set_light(RadiationModel& model, const MomentLight& light);

// Simulates the steps of the plan in their order, until hooks.monitor.interrupted stops them; a step that was begun is left out
// then. The monitor's report is of the whole day; hooks.checkpoint is not used, since the sink keeps the steps. Throws as
// Simulation::solve does, and what the sink throws.
[[nodiscard]] SimulatedDay simulate_day(Simulation& simulation, const DayPlan& plan, const SolveSettings& settings,
                                        DaySink& sink, const RunHooks& hooks);

}  // namespace sunfleck

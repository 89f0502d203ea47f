#pragma once
// Simulates the steps of one or several days, block by block with one tree. The steps of a block are simulated together.
//
// A block whose first step is n, from 0, has the seed RandomStream(seed, n).word(), and so have the sensors of step n. Where it
// can, a block begins with the work that an earlier step, or the block at the same hours of an earlier date, would now choose
// (RadiationResult::next_work), which is stored with each step: a day that was stopped anywhere and is resumed gives the same bytes
// as one that was not.

#include "files/results/stores/step_store.h"
#include "files/results/tables/day_summary.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/solve/solve.h"
#include "simulate/day_plan.h"
#include "simulate/requests.h"
#include "simulate/simulation.h"

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace sunfleck {

// Receives the steps of a day, and provides the steps that were simulated earlier.
class DaySink {
 public:
  virtual ~DaySink() = default;
  // Returns a daytime step that was simulated earlier; empty if it has yet to be simulated.
  [[nodiscard]] virtual std::optional<StoredStep> find(std::size_t step) = 0;
  // Returns whether the steps need the light of every triangle.
  [[nodiscard]] virtual StepFields fields() const = 0;
  // Returns the store of the state of the block that is being simulated, if states are kept; see StepStore::block_store.
  [[nodiscard]] virtual std::optional<RunStore> block_store(const nlohmann::ordered_json& settings) = 0;
  // Takes a step that was just simulated, in the order of the steps; its light, fields and maps are not used afterwards.
  virtual void take(std::size_t step, StoredStep& simulated) = 0;
};

struct SimulatedDay {
  std::size_t steps = 0;  // number of finished steps, from the first; fewer than the plan has if the day was stopped
  DayTotals totals;
};

// Returns the solver's settings for the steps, which estimate the light of triangles if work.triangle_light. They contain no time
// limit: --max-seconds interrupts a day between rays instead of making replicates smaller, so that its bytes do not depend on the
// clock. Of the memory, by default half of what is free, one half is for replicates in progress, as for a run, and the other
// one for the sums of steps that are simulated together.
[[nodiscard]] SolveSettings day_solve_settings(const WorkRequest& work, const Scene& scene, int threads);

// Gives the plan its blocks: of request.steps_together steps, else of as many as the memory holds, but of single steps if the
// number of rays is limited, since the limit applies to each step.
void plan_blocks(const DayRequest& request, const SolveSettings& settings, const RadiationModel& model, DayPlan& plan);

// Returns everything on which the bytes of a finished step depend.
[[nodiscard]] nlohmann::ordered_json day_settings(const DayRequest& request, const Scene& scene, const SolveSettings& settings,
                                                  const DayPlan& plan, StepFields fields);

// Returns how many steps an earlier day in the folder simulated together; nothing if there is none.
[[nodiscard]] std::optional<int> noted_steps_together(const std::filesystem::path& folder);

// Simulates the blocks of the plan in their order, until hooks.monitor.interrupted stops them; of the block in progress only
// its state is kept. The monitor's report covers the whole day; hooks.checkpoint is not used, since the sink stores the steps
// and the state. Throws as Simulation::solve does, and what the sink throws.
[[nodiscard]] SimulatedDay simulate_day(Simulation& simulation, const DayPlan& plan, const SolveSettings& settings,
                                        DaySink& sink, const RunHooks& hooks);

}  // namespace sunfleck

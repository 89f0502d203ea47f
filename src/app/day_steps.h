#pragma once
// The steps of a day, simulated one after the other with one tree.

#include "app/day_plan.h"
#include "app/engine.h"
#include "app/options.h"
#include "io/day_summary.h"
#include "io/scene_reader.h"
#include "io/step_store.h"
#include "transport/counters.h"
#include "transport/solve.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace sunfleck {

// All that the bytes of a finished step depend on.
[[nodiscard]] nlohmann::ordered_json day_settings(const DayOptions& options, const Scene& scene, const SolveSettings& settings,
                                                  const DayPlan& plan);

// Puts a model under the light of a moment.
void set_light(RadiationModel& model, const MomentLight& light);

// Each step begins with the work that the step before it found to be needed, so that steps come in their order.
class DaySteps {
 public:
  // All must outlive it; helpers may be null. Steps have their own seeds, drawn from that of the settings, which have no limit
  // of time.
  DaySteps(RadiationModel& model, const DayPlan& plan, const SolveSettings& settings, const CounterLayout& layout,
           Engine& engine, ReplicateHelpers* helpers = nullptr);

  // Puts the model under the light of a step by day, and simulates it. Empty if stopped meanwhile. `report` may be empty.
  // Throws as `solve` does.
  [[nodiscard]] std::optional<StoredStep> simulate(std::size_t step, const StopQuestion& stop,
                                                   const std::function<void(const Progress&)>& report);

  // Takes note of a step that is done, whoever did it and when.
  void count(const StoredStep& step);

  [[nodiscard]] const DayTotals& totals() const { return totals_; }

 private:
  [[nodiscard]] std::optional<RadiationResult> solve_step(const SolveSettings& settings, const StopQuestion& stop,
                                                          const std::function<void(const Progress&)>& report);

  RadiationModel& model_;
  const DayPlan& plan_;
  const SolveSettings& settings_;
  const CounterLayout& layout_;
  Engine& engine_;
  ReplicateHelpers* helpers_;
  std::optional<Work> next_work_;
  DayTotals totals_;
};

}  // namespace sunfleck

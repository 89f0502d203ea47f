#include "simulate/in_memory_day.h"

#include "base/stopwatch.h"
#include "simulate/day.h"
#include "simulate/scene_source.h"
#include "simulate/simulation.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace sunfleck {
namespace {

class MemorySink final : public DaySink {
 public:
  explicit MemorySink(std::size_t steps) : fields(steps) {}
  [[nodiscard]] std::optional<StoredStep> find(std::size_t) override { return std::nullopt; }
  void take(std::size_t step, StoredStep& simulated) override { fields[step] = std::move(simulated.fields); }

  std::vector<std::vector<float>> fields;  // [step]
};

}  // namespace

InMemoryDay simulate_in_memory(Scene scene, const DayRequest& request, const WorkRequest& work, const DeviceRequest& device,
                               const Monitor& monitor) {
  Stopwatch total;
  remove_receivers(scene);
  const SolveSettings settings = day_solve_settings(work, scene, device.threads);
  const DayPlan plan = plan_day_in_blocks(request, work, scene, settings);
  check_grid(work, scene);
  Simulation simulation(std::move(scene), device);
  RunHooks hooks{monitor};
  const Stopwatch clock;
  hooks.monitor.interrupted = [&] {
    return (monitor.interrupted && monitor.interrupted()) || (work.max_seconds && clock.seconds() >= *work.max_seconds);
  };
  MemorySink sink(plan.course.steps.size());
  SimulatedDay simulated = simulate_day(simulation, plan, settings, sink, hooks);

  RunRecord record = simulation.record(settings);
  record.max_seconds = work.max_seconds;
  record.complete = simulated.lights.size() == plan.course.steps.size() && simulated.totals.short_of_bound == 0;
  record.seconds.total = total.lap();
  const Scene& done = simulation.scene();
  const nlohmann::ordered_json kept = day_settings(request, done, settings, plan);
  std::string summary = day_summary_json({record, done.model, plan.course, simulated.lights, simulated.totals, kept});
  sink.fields.resize(simulated.lights.size());
  return {std::move(simulation.scene()), plan, record, std::move(simulated.lights), std::move(sink.fields), std::move(summary)};
}

}  // namespace sunfleck

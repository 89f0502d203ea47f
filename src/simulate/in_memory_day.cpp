#include "simulate/in_memory_day.h"

#include "base/file.h"
#include "base/stopwatch.h"
#include "files/results/tables/day_fields.h"
#include "simulate/day.h"
#include "simulate/simulation.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace sunfleck {
namespace {

// Keeps what a day in memory needs of each step.
class MemorySink final : public DaySink {
 public:
  MemorySink(const RadiationModel& model, const DayPlan& plan, StepFields keep)
      : lights(plan.course.steps.size(), no_light(model)),
        fields_of(plan.course.steps.size()),
        maps_of(plan.course.steps.size()),
        plane_sums(model),
        course_(plan.course),
        keep_(keep) {}

  [[nodiscard]] std::optional<StoredStep> find(std::size_t) override { return std::nullopt; }
  [[nodiscard]] StepFields fields() const override { return keep_; }
  [[nodiscard]] std::optional<RunStore> block_store(const nlohmann::ordered_json&) override { return std::nullopt; }
  void take(std::size_t step, StoredStep& simulated) override {
    lights[step] = std::move(simulated.light);
    for (; counted_ < step; ++counted_) plane_sums.add_unlit();
    plane_sums.add(course_.steps[step], simulated.maps);
    ++counted_;
    if (keep_ == StepFields::none) return;
    fields_of[step] = std::move(simulated.fields);
    maps_of[step] = std::move(simulated.maps);
  }
  // Leaves the first `steps` steps, which are finished.
  void end_after(std::size_t steps) {
    for (; counted_ < steps; ++counted_) plane_sums.add_unlit();
    lights.resize(steps);
    fields_of.resize(steps);
    maps_of.resize(steps);
  }

  std::vector<StepLight> lights;                       // [step]
  std::vector<std::vector<float>> fields_of, maps_of;  // [step]
  PlaneMapSums plane_sums;

 private:
  const DayCourse& course_;
  StepFields keep_;
  std::size_t counted_ = 0;  // steps that plane_sums has
};

}  // namespace

InMemoryDay simulate_in_memory(Scene scene, const DayRequest& request, const WorkRequest& work, const DeviceRequest& device,
                               const Monitor& monitor) {
  Stopwatch total;
  const SolveSettings settings = day_solve_settings(work, scene, device.threads);
  DayPlan plan = plan_day(request, scene);
  for (std::string& warning : plan_warnings(plan, scene)) scene.warnings.push_back(std::move(warning));
  plan_blocks(request, settings, scene.model, plan);
  check_grid(work, scene);
  Simulation simulation(std::move(scene), device);
  RunHooks hooks{monitor};
  const Stopwatch clock;
  hooks.monitor.interrupted = [&] {
    return monitor.is_interrupted() || (work.max_seconds && clock.seconds() >= *work.max_seconds);
  };
  const StepFields keep = work.triangle_light ? StepFields::kept : StepFields::none;
  MemorySink sink(simulation.model(), plan, keep);
  const SimulatedDay simulated = simulate_day(simulation, plan, settings, sink, hooks);
  sink.end_after(simulated.steps);

  RunRecord record = simulation.record(settings);
  record.max_seconds = work.max_seconds;
  record.complete = simulated.steps == plan.course.steps.size() && simulated.totals.short_of_bound == 0;
  record.seconds.total = total.lap();
  const Scene& done = simulation.scene();
  const nlohmann::ordered_json kept = day_settings(request, done, settings, plan, keep);
  const std::vector<DateSums> sums = sum_dates(plan.course, sink.lights);
  std::string summary = day_summary_json({record, done.model, plan.course, simulated.steps, sums, simulated.totals, kept});
  return {std::move(simulation.scene()),
          plan,
          record,
          std::move(sink.lights),
          std::move(sink.fields_of),
          std::move(sink.maps_of),
          work.triangle_light,
          std::move(sink.plane_sums),
          std::move(summary)};
}

bool keeps_triangles(const DayRequest& request, const Scene& scene) {
  const DayPlan plan = plan_day(request, scene);
  if (plan.course.dates.size() > 1) return false;
  const double values = static_cast<double>(plan.course.steps.size()) * static_cast<double>(scene.model.canopy.size()) *
                        static_cast<double>(scene.model.bands.size() * day_columns(scene.model).size());
  return values * sizeof(float) <= static_cast<double>(available_memory_bytes()) / 4.0;
}

}  // namespace sunfleck

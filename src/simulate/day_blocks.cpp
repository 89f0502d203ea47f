#include "simulate/day_blocks.h"

#include "physics/transport/model/counters.h"
#include "physics/transport/solve/darkness.h"

#include <algorithm>

namespace sunfleck {
namespace {

// More lights gain little: the time of a block then grows with their number.
constexpr double most_useful_lights = 96;

// Returns the memory that each light of a block takes: its sums over the run and, in replicates that are made or added meanwhile, its
// counters and its sums by side, which are first kept with those of all lights.
double bytes_per_light(const RadiationModel& model, const SolveSettings& settings) {
  const CounterLayout layout = make_counter_layout(model);
  const auto elements = static_cast<double>(model.canopy.size());
  const auto bands = static_cast<double>(model.bands.size());
  const double kinds = model.sky ? 2.0 : 1.0;  // of light by side: all, and that of the sky
  const double by_side = 2.0 * elements * bands * sizeof(std::int64_t) * kinds;
  const double by_element = elements * sizeof(BeamLandings);
  const double kept = refines(settings.element_errors) ? 2.0 : 1.0;
  const double cells = static_cast<double>(layout.cells()) * bands * sizeof(std::int64_t) * kinds;
  const double of_run = kept * (by_side + by_element) + elements * sizeof(float) + cells;
  const double of_replicate = 2.0 * by_side + cells + static_cast<double>(layout.words()) * sizeof(std::uint32_t);
  return of_run + (settings.replicates_at_once + 1.0) * of_replicate;
}

}  // namespace

std::size_t most_lights(const RadiationModel& model, const SolveSettings& settings, bool memory_asked) {
  if (settings.max_rays) return 1;
  double bytes = usual_block_bytes;
  if (settings.memory_bytes) bytes = memory_asked ? *settings.memory_bytes : std::min(bytes, *settings.memory_bytes);
  return static_cast<std::size_t>(std::clamp(bytes / bytes_per_light(model, settings), 1.0, most_useful_lights));
}

void plan_blocks(const RadiationModel& model, std::size_t most, DayPlan& plan) {
  const std::vector<DayStep>& steps = plan.course.steps;
  plan.blocks.clear();
  const auto cut = [&](std::size_t first, std::size_t end) {
    const std::size_t parts = (end - first + most - 1) / most;
    for (std::size_t part = 0; part < parts; ++part) {
      plan.blocks.push_back({first + (end - first) * part / parts, first + (end - first) * (part + 1) / parts});
    }
  };
  std::size_t first = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    RadiationModel light = model;
    if (!steps[i].night()) set_light(light, plan.lights[i]);
    const bool alone = steps[i].night() || is_dark(light);
    if (alone || steps[i].date != steps[first].date) {
      cut(first, i);
      first = i;
    }
    if (!alone) continue;
    if (!steps[i].night()) plan.blocks.push_back({i, i + 1});
    first = i + 1;
  }
  cut(first, steps.size());
}

std::vector<RadiationModel> lights_of(const RadiationModel& model, const DayPlan& plan, const DayBlock& block) {
  std::vector<RadiationModel> lights(block.size(), model);
  for (std::size_t k = 0; k < lights.size(); ++k) set_light(lights[k], plan.lights[block.first + k]);
  return lights;
}

void set_light(RadiationModel& model, const MomentLight& light) {
  model.sun = light.sun;
  model.bands = light.bands;
  model.sky = light.sky;
}

}  // namespace sunfleck

#include "simulate/day_blocks.h"

#include "base/rounding.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/darkness.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Returns the memory of the sums of one light, of a run and its pilots.
double light_bytes(const RadiationModel& model, bool has_sky, bool of_triangles) {
  const double series = 2.0;
  const double halves = of_triangles ? 1.5 : 1.0;
  const auto elements = static_cast<double>(model.canopy.size());
  const double sides = 2.0 * elements * static_cast<double>(model.bands.size()) * sizeof(std::int64_t) * (has_sky ? 2.0 : 1.0);
  const double landings = elements * (sizeof(BeamLandings) + sizeof(float));
  return series * halves * (sides + landings);
}

}  // namespace

std::size_t steps_in_memory(const RadiationModel& model, const DayPlan& plan, bool of_triangles, double memory_bytes) {
  const bool has_sky =
      std::any_of(plan.lights.begin(), plan.lights.end(), [](const MomentLight& l) { return l.sky.has_value(); });
  return lights_in_memory(model, has_sky, of_triangles, memory_bytes);
}

std::size_t lights_in_memory(const RadiationModel& model, bool has_sky, bool of_triangles, double memory_bytes) {
  const double fit = memory_bytes / std::max(1.0, light_bytes(model, has_sky, of_triangles));
  return static_cast<std::size_t>(std::clamp(fit, 1.0, double{usual_steps_together}));
}

void plan_blocks(const RadiationModel& model, std::size_t most, DayPlan& plan) {
  const std::vector<DayStep>& steps = plan.course.steps;
  plan.blocks.clear();
  const auto cut = [&](std::size_t first, std::size_t end) {
    const std::size_t parts = block_count(end - first, most);
    for (std::size_t part = 0; part < parts; ++part) {
      plan.blocks.push_back({first + (end - first) * part / parts, first + (end - first) * (part + 1) / parts});
    }
  };
  std::size_t first = 0;
  RadiationModel light = model;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i].unlit()) set_light(light, plan.lights[i]);
    const bool alone = steps[i].unlit() || (!steps[i].lamps && is_dark(light));
    if (alone || steps[i].date != steps[first].date) {
      cut(first, i);
      first = i;
    }
    if (!alone) continue;
    if (!steps[i].unlit()) plan.blocks.push_back({i, i + 1});
    first = i + 1;
  }
  cut(first, steps.size());
}

std::uint64_t number_of(const DayBlock& block) {
  return std::uint64_t{block.first} << 32U | block.end;
}

DayBlock block_of(std::uint64_t number) {
  return {number >> 32U, number & 0xffffffffU};
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

#include "simulate/day_blocks.h"

#include "physics/transport/solve/darkness.h"

namespace sunfleck {

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
  RadiationModel light = model;
  for (std::size_t i = 0; i < steps.size(); ++i) {
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

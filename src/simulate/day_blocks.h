#pragma once
// Blocks of steps that are simulated together. The steps of a block share their packets (physics/transport/model/lights.h), so that a
// block of many costs far less time than its steps do one by one, but takes memory for each of them.

#include "physics/transport/model/model.h"
#include "simulate/day_plan.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// Gives the plan the blocks of all daytime steps, each with at most `most` of them. The blocks between two nights or dark steps are
// of nearly the same size.
void plan_blocks(const RadiationModel& model, std::size_t most, DayPlan& plan);

// Returns the models of the block's steps, which share the canopy.
[[nodiscard]] std::vector<RadiationModel> lights_of(const RadiationModel& model, const DayPlan& plan, const DayBlock& block);

// Sets the light of a moment in a model.
void set_light(RadiationModel& model, const MomentLight& light);

}  // namespace sunfleck

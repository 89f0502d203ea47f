#pragma once
// Blocks of steps that are simulated together. The steps of a block share their packets (physics/transport/model/lights.h), so that a
// block costs little more than a step, but takes memory for each of them.

#include "physics/transport/model/model.h"
#include "physics/transport/solve/solve.h"
#include "simulate/day_plan.h"

#include <cstddef>
#include <vector>

namespace sunfleck {

// The memory that blocks may take if the user sets no limit, in bytes, unless half of the free memory is less. It is the same on
// all machines with enough memory, so that these simulate the same blocks and find the same light.
inline constexpr double usual_block_bytes = 0x1p32;

// Returns the largest number of steps that fit in the memory together: `settings.memory_bytes` limits it if the user asked for that,
// otherwise usual_block_bytes. It is 1 if the number of rays is limited, since that limit holds for single steps.
[[nodiscard]] std::size_t most_lights(const RadiationModel& model, const SolveSettings& settings, bool memory_asked);

// Gives the plan the blocks of all daytime steps, each with at most `most` of them. The blocks between two nights or dark steps are
// of nearly the same size.
void plan_blocks(const RadiationModel& model, std::size_t most, DayPlan& plan);

// Returns the models of the block's steps, which share the canopy.
[[nodiscard]] std::vector<RadiationModel> lights_of(const RadiationModel& model, const DayPlan& plan, const DayBlock& block);

// Sets the light of a moment in a model.
void set_light(RadiationModel& model, const MomentLight& light);

}  // namespace sunfleck

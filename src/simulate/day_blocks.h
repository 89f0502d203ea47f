#pragma once
// Blocks of steps that are simulated together. The steps of a block share their packets (physics/transport/model/lights.h), so
// that a block of many costs far less time than its steps do one by one, but takes memory for each of them.

#include "physics/transport/model/model.h"
#include "simulate/day_plan.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

inline constexpr int most_steps_together = 96;
inline constexpr int usual_steps_together = 6;

// Returns how many steps are simulated together by default: as many as their sums fit into `memory_bytes`, at least one and at
// most usual_steps_together: more steps need more memory and hardly less time. `of_triangles` says whether the light of single
// triangles is wanted. The number depends on nothing but the sizes of the scene and the memory.
[[nodiscard]] std::size_t steps_in_memory(const RadiationModel& model, const DayPlan& plan, bool of_triangles,
                                          double memory_bytes);

// Returns the same for other lights of a scene.
[[nodiscard]] std::size_t lights_in_memory(const RadiationModel& model, bool has_sky, bool of_triangles, double memory_bytes);

// Gives the plan the blocks of all lit steps, each with at most `most` of them. The blocks between two unlit or dark steps
// are of nearly the same size.
void plan_blocks(const RadiationModel& model, std::size_t most, DayPlan& plan);

// Return a block as a number, by which the ranks of a job name it, and the block of a number.
[[nodiscard]] std::uint64_t number_of(const DayBlock& block);
[[nodiscard]] DayBlock block_of(std::uint64_t number);

// Returns the models of the block's steps, which share the canopy.
[[nodiscard]] std::vector<RadiationModel> lights_of(const RadiationModel& model, const DayPlan& plan, const DayBlock& block);

// Sets the light of a moment in a model.
void set_light(RadiationModel& model, const MomentLight& light);

}  // namespace sunfleck

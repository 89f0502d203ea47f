#pragma once
// Scenes without any light.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/solve.h"

namespace sunfleck {

// Returns true if a surface emits light.
[[nodiscard]] bool has_lamps(const RadiationModel& model);

// Returns true if no light comes from sun or sky and no surface emits any.
[[nodiscard]] bool is_dark(const RadiationModel& model);

// Returns what solve() gives for such a scene: every flux is exactly zero, and shares of the beam are undefined.
[[nodiscard]] RadiationResult dark_result(const RadiationModel& model, const CounterLayout& layout,
                                          const SolveSettings& settings);

}  // namespace sunfleck

#pragma once
// Scenes without any light.

#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/solve.h"

namespace sunfleck {

// Returns true if no light comes from sun or sky and no surface emits any.
[[nodiscard]] bool is_dark(const RadiationModel& model);

// Returns what solve() gives for such a scene: every flux is exactly zero, and shares of the beam are undefined.
[[nodiscard]] RadiationResult dark_result(const RadiationModel& model, const CounterLayout& layout,
                                          const SolveSettings& settings);

}  // namespace sunfleck

#pragma once
// A scene without any light.

#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "transport/solve.h"

namespace sunfleck {

// True if nothing comes in from sun or sky, and no surface glows.
[[nodiscard]] bool is_dark(const RadiationModel& model);

// The result of solve() for it: every flux is exactly zero, and shares of the beam do not exist.
[[nodiscard]] RadiationResult dark_result(const RadiationModel& model, const CounterLayout& layout,
                                          const SolveSettings& settings);

}  // namespace sunfleck

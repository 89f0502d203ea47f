#pragma once
// Forecasts the peak memory of a run.

#include "app/engine.h"
#include "app/simulation.h"
#include "transport/solve.h"

#include <cstdint>
#include <optional>

namespace sunfleck {

struct MemoryForecast {
  std::uint64_t bytes = 0;  // the whole process, without pictures and exports
  RunForecast run;
};

// Runs the pilots of a run with these settings and returns the memory it will need; none if interrupted. Compared with the
// resident memory of runs of 1 to 10 million triangles on the CPU path and on lavapipe, the forecast was within 20 %.
[[nodiscard]] std::optional<MemoryForecast> forecast_memory(const RadiationModel& model, const SceneTree& tree, Engine& engine,
                                                            const SolveSettings& settings);

}  // namespace sunfleck

#pragma once
// How much memory a run will take at its height.

#include "simulate/simulation.h"
#include "transport/solve.h"

#include <cstdint>
#include <optional>

namespace sunfleck {

struct MemoryForecast {
  std::uint64_t bytes = 0;  // of the whole process, without pictures and exports
  RunForecast run;
};

// Runs the pilots of a run with these settings, and returns what it will need; none if interrupted. Measured against the
// resident memory of runs of 1 to 10 million triangles on the CPU path and on lavapipe: within 20 %.
[[nodiscard]] std::optional<MemoryForecast> forecast_memory(Simulation& simulation, const SolveSettings& settings,
                                                            const Monitor& monitor);

}  // namespace sunfleck

#pragma once
// Forecasts the peak memory of a run.

#include "physics/transport/solve/solve.h"
#include "simulate/simulation.h"

#include <cstdint>
#include <optional>

namespace sunfleck {

struct MemoryForecast {
  // Peaks of the whole process, without exports and gnuplot: with the usual pictures, and with none.
  std::uint64_t bytes = 0, bytes_without_pictures = 0;
  RunForecast run;
};

// Runs the pilots of a run with these settings and returns the memory it will need, or nothing if interrupted. Compared with
// the resident memory of runs of 1 to 10 million triangles on the CPU path and on lavapipe, the forecast was within 20 %.
// `without_pictures` is what the run keeps of single triangles if it draws nothing.
[[nodiscard]] std::optional<MemoryForecast> forecast_memory(Simulation& simulation, const SolveSettings& settings,
                                                            ElementErrors without_pictures, const Monitor& monitor);

}  // namespace sunfleck

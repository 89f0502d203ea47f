#pragma once
// Runs a scene with all the settings of a tradeoff, and with the reference they are compared with.

#include "app/options.h"
#include "io/tradeoff_table.h"
#include "simulate/simulation.h"
#include "transport/solve.h"

#include <filesystem>

namespace sunfleck {

[[nodiscard]] Quantity asked_quantity(const TradeoffOptions& options);

// Adds the reference's figures and the rungs to the report, and writes the table after every rung. False if Ctrl-C or
// --max-seconds ended it before all was measured; a rung that was begun stays with the runs that are whole.
[[nodiscard]] bool measure_tradeoff(const TradeoffOptions& options, const SolveSettings& settings, Simulation& simulation,
                                    const std::filesystem::path& table, TradeoffReport& report);

}  // namespace sunfleck

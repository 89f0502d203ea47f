#pragma once
// Runs a scene with all the settings of a trade-off, and with the reference they are compared with.

#include "files/results/tables/tradeoff_table.h"
#include "physics/transport/solve/solve.h"
#include "programs/cli/options.h"
#include "simulate/simulation.h"

#include <filesystem>

namespace sunfleck {

[[nodiscard]] Quantity requested_quantity(const TradeoffOptions& options);

// Adds the figures of the reference and the measured settings to the report, and writes the table after every setting. Returns
// false if Ctrl-C or --max-seconds ended the work before all was measured; an unfinished setting stays in the report with its
// complete runs.
[[nodiscard]] bool measure_tradeoff(const TradeoffOptions& options, const SolveSettings& settings, Simulation& simulation,
                                    const std::filesystem::path& table, TradeoffReport& report);

}  // namespace sunfleck

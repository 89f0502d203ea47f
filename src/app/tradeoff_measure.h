#pragma once
// Runs a scene with all the settings of a trade-off, and with the reference they are compared with.

#include "app/engine.h"
#include "app/options.h"
#include "io/tradeoff_table.h"
#include "transport/solve.h"

#include <filesystem>

namespace sunfleck {

// A scene on a device.
struct Bench {
  const RadiationModel& model;
  const CounterLayout& layout;
  Engine& engine;
};

[[nodiscard]] Quantity asked_quantity(const TradeoffOptions& options);

// Adds the figures of the reference and the measured settings to the report, and writes the table after every setting. Returns
// false if Ctrl-C or --max-seconds ended the work before all was measured; an unfinished setting stays in the report with its
// complete runs.
[[nodiscard]] bool measure_tradeoff(const TradeoffOptions& options, const SolveSettings& settings, const Bench& bench,
                                    const std::filesystem::path& table, TradeoffReport& report);

}  // namespace sunfleck

#pragma once
// The behaviour that all simulating commands share at a terminal: messages, progress, Ctrl-C and the exit status.

#include "base/log.h"
#include "files/results/tables/result_writer.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/solve.h"
#include "programs/cli/options.h"
#include "simulate/interrupt.h"
#include "simulate/simulation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_short_of_bound = 1;

// Starts the log, which is quiet with --quiet and --json, warns of options without effect, and lets an interrupt end the program
// while nothing is written yet.
void start_at_terminal(const RunOptions& options);

// Returns the device in use, as one line for the user.
[[nodiscard]] std::string device_line(const TracerDevice& device);

// Returns a monitor that draws the progress line, which must outlive it, and that Ctrl-C interrupts.
[[nodiscard]] Monitor terminal_monitor(ProgressLine& line);

// Runs the simulation with a progress line, until Ctrl-C. The checkpoint and the ranks may be null.
[[nodiscard]] SimulatedScene simulate_at_terminal(Simulation& simulation, const SolveSettings& settings,
                                                  Checkpoint* checkpoint = nullptr, Ranks* ranks = nullptr);

[[nodiscard]] int exit_status(StopReason stop);

// Reports in one line why a run ended early and which figures of which pass fell short of their bounds, and then `outcome`: what
// becomes of the results. Prints nothing if a run did all its work.
void warn_if_short(const SimulatedScene& simulated, const SolveSettings& settings, std::string_view outcome);

// Warns if triangles are exported whose light typically is known to no better than 20 %.
void warn_of_coarse_triangles(const SimulatedScene& simulated, const std::vector<std::string>& exports);

// Reports that the `work` in the folder, a run or a day, is finished, or prints its summary if --json requests it. Returns the
// exit status. Warns of pictures that are requested by name and that the folder lacks.
[[nodiscard]] int report_finished(const std::filesystem::path& folder, const RunOptions& options, std::string_view work);

// Prints the balance of a result and its folder, or its summary if --json requests it.
void print_result(const std::filesystem::path& folder, const RunOptions& options, const SimulatedScene& simulated);

}  // namespace sunfleck

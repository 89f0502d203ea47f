#pragma once
// What every simulating command does alike.

#include "app/engine.h"
#include "app/options.h"
#include "app/run_keeper.h"
#include "base/log.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "transport/counters.h"
#include "transport/result.h"
#include "transport/solve.h"

#include <chrono>
#include <string_view>

namespace sunfleck {

class Ranks;

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_short_of_bound = 1;
inline constexpr int exit_interrupted = 130;

// Seconds since the last question.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A scene's tree with its counters.
struct SceneTree {
  explicit SceneTree(const RadiationModel& model);
  CounterLayout layout;
  Bvh bvh;
};

[[nodiscard]] SolveSettings solve_settings(const RunOptions& options, const Scene& scene);

// Throws Error (input) for a --grid finer than the scene's rays can be numbered.
void check_grid(const RunOptions& options, const Scene& scene);

[[nodiscard]] RunRecord make_record(const RunOptions& options, const Scene& scene, const SolveSettings& settings,
                                    const Engine& engine);

// The device in use, as one line for the user.
[[nodiscard]] std::string device_line(const TracerDevice& device);

// Who takes part in a simulation besides; either may be null.
struct SimulationAids {
  RunKeeper* keeper = nullptr;  // has the state kept
  Ranks* ranks = nullptr;       // make replicates too
};

[[nodiscard]] CpuTracer::Scene traced_scene(const RadiationModel& model);

// What a progress line shows of a solver's progress.
[[nodiscard]] ProgressLine::State progress_state(const Progress& progress);

// Simulates, sensors included, with a progress line; ends at Ctrl-C.
[[nodiscard]] RadiationResult simulate(const RadiationModel& model, const CounterLayout& layout, Engine& engine,
                                       const SolveSettings& settings, const SimulationAids& aids = {});

// The same, watched and ended by somebody else.
[[nodiscard]] RadiationResult simulate(const RadiationModel& model, const CounterLayout& layout, Engine& engine,
                                       const SolveSettings& settings, const Monitor& monitor,
                                       ReplicateHelpers* helpers = nullptr);

// Throws Error (failure) for a message of the validation layer: that is our own mistake, and nothing that was computed can be
// trusted.
void check_validation(const Engine& engine);

[[nodiscard]] bool is_done(StopReason stop);
[[nodiscard]] int exit_status(StopReason stop);

// Says in one line what ended a run early, which figures of which pass are short of their bounds, and `cure`; nothing about
// other runs.
void warn_if_short(const SolveSettings& settings, const RadiationModel& model, const RadiationResult& result,
                   std::string_view cure = "");

// The part of a pass in that line: "direct error 0.0037 of 0.001 (beam on vegetation)". Empty for a pass that reached its
// bound, has none, or has no light.
[[nodiscard]] std::string shortfall(const char* pass, const std::optional<double>& error, const std::optional<double>& bound,
                                    const std::optional<JudgedFigure>& judged, const RadiationModel& model);

}  // namespace sunfleck

#pragma once
// A scene with its tree on a device, with which the commands, the window, Python and the ranks of an MPI job simulate.

#include "base/stopwatch.h"
#include "devices/tracers/remembered_beams.h"
#include "files/results/tables/result_writer.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/solve.h"
#include "simulate/requests.h"
#include "simulate/simulated_scene.h"

#include <cstddef>
#include <memory>

namespace sunfleck {

class Checkpoint;
class Ranks;
class ReplicateHelpers;

// Returns the solver's settings for this work. `threads` has the same meaning as in DeviceRequest.
[[nodiscard]] SolveSettings solve_settings(const WorkRequest& work, const Scene& scene, int threads = 0);

// Throws Error (input) for a grid so fine that the scene's rays could not be numbered.
void check_grid(const WorkRequest& work, const Scene& scene);

// Observers and participants of a run. All may be empty.
struct RunHooks {
  // Called from the simulating thread; other threads may ask it to interrupt the run.
  Monitor monitor;
  Checkpoint* checkpoint = nullptr;  // keeps the run's state
  Ranks* ranks = nullptr;            // make replicates too

  // Returns whether the monitor or the ranks ask to end the run.
  [[nodiscard]] bool interrupted() const;
  [[nodiscard]] ReplicateHelpers* helpers() const;
};

class Simulation {
 public:
  // Builds the tree and opens the device. Software Vulkan takes its number of threads from the first simulation of a process.
  // Throws Error (device).
  Simulation(Scene scene, const DeviceRequest& device, EngineUse use = EngineUse::one_thread);

  // Returns a simulation of a model with the same triangles, soil and plot, which shares the tree and the device.
  [[nodiscard]] Simulation with_model(RadiationModel model) const;

  // Gives the scene other light, like relight of files/scene/scene_reader.h. Existing results keep the scene to which they
  // belong.
  void relight(const SceneText& light, const SceneAccess& access);

  // Returns the scene. Through the mutable reference only its light, optics and title may be changed, and only while nothing is
  // being simulated.
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] const RadiationModel& model() const { return scene_->model; }

  // Keeps landings of beams for runs with other optics, as long as they fit into `most_bytes`.
  void remember_beams(std::size_t most_bytes);
  [[nodiscard]] std::uint64_t spared_beams() const { return beams_ ? beams_->spared() : 0; }

  // Simulates the scene, sensors included. Throws as `solve` of physics/transport/solve/solve.h does.
  [[nodiscard]] RadiationResult solve(const SolveSettings& settings, const Monitor& monitor,
                                      ReplicateHelpers* helpers = nullptr);

  // Simulates the scene in several lights that share packets, without sensors; see solve_lights of
  // physics/transport/solve/solve.h. The models must be the scene's apart from their light.
  [[nodiscard]] SharedOutcome solve_lights(Lights lights, const SolveSettings& settings, const Monitor& monitor,
                                           ReplicateHelpers* helpers, const WantedSums& sums, const TakeLight& take);

  // Measures the sensors of the model, in its light, and adds them to its result, whose `stop` tells if that was interrupted.
  // `watch` has run since the simulation began.
  void add_sensors(const RadiationModel& model, const SolveSettings& settings, const Monitor& monitor, const Stopwatch& watch,
                   RadiationResult& result);

  // Simulates the scene and returns the result with its record, which describes how it was computed.
  [[nodiscard]] SimulatedScene run(const SolveSettings& settings, const RunHooks& hooks = {});

  // Returns a result of this scene with its record.
  [[nodiscard]] SimulatedScene simulated(const SolveSettings& settings, RadiationResult result) const;

  // Returns a record of the simulation, without a result.
  [[nodiscard]] RunRecord record(const SolveSettings& settings) const;

  [[nodiscard]] const Tracing& tracing() const { return *tracing_; }
  [[nodiscard]] Tracing& tracing() { return *tracing_; }
  [[nodiscard]] const CounterLayout& layout() const { return tracing_->tree.layout; }
  [[nodiscard]] TracerDevice device() const { return tracing_->engine.device(); }
  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] std::size_t tree_bytes() const;

  // Throws Error (failure) for a message of the validation layer: such a message indicates a mistake in the program, so no
  // computed value can be trusted.
  void check_validation() const;

 private:
  Simulation(std::shared_ptr<Scene> scene, std::shared_ptr<Tracing> tracing, int threads);

  [[nodiscard]] Tracer& tracer() { return beams_ ? *beams_ : tracing_->engine.tracer(); }

  std::shared_ptr<Scene> scene_;
  std::shared_ptr<Tracing> tracing_;
  int threads_;
  std::unique_ptr<RememberedBeams> beams_;
};

}  // namespace sunfleck

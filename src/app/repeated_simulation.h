#pragma once
// A scene that is simulated again and again, as growth models do: its tree and its device are made once, and other light costs
// no more than its tracing.

#include "app/engine.h"
#include "app/options.h"
#include "app/simulation.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "transport/result.h"
#include "transport/solve.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace sunfleck {

// What a canopy is traced with.
struct TracingKit {
  TracingKit(const RadiationModel& model, const std::string& device);
  SceneTree tree;
  Engine engine;
};

// A result with the scene as it was, whatever becomes of the simulation.
struct SimulatedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<TracingKit> kit;
  RunRecord record;
  RadiationResult result;

  // Into a folder, what `run` would write there with these options: of them output, exports, images, pictures. The folder is
  // replaced if it holds an earlier result. Throws Error as `run` does.
  void write(const RunOptions& options) const;
};

class RepeatedSimulation {
 public:
  // `device` as on the command line; `threads` of the CPU path, 0: all cores. Software Vulkan takes its number from the first
  // simulation of a process. Throws Error (device).
  RepeatedSimulation(Scene scene, const std::string& device, int threads);

  // As relight of io/scene_reader.h; results at hand stay what they are.
  void relight(const SceneText& light, const SceneAccess& access);

  // What `run` computes with these options, bit for bit. Throws Error (input) for a grid that is too fine, Error (failure) as
  // `solve` does. `monitor` is called from this thread, but may ask to be interrupted from others.
  [[nodiscard]] SimulatedScene run(const RunOptions& options, const Monitor& monitor);

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] TracerDevice device() const { return kit_->engine.device(); }
  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] std::size_t tree_bytes() const;

 private:
  std::shared_ptr<Scene> scene_;
  int threads_;
  RunRecord::Seconds seconds_;  // of loading, which run() hands on with the first result
  std::shared_ptr<TracingKit> kit_;
};

}  // namespace sunfleck

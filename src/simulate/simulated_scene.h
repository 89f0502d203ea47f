#pragma once
// A result together with the scene it is of and the tree it is drawn with.

#include "base/stopwatch.h"
#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "pictures/pictures.h"
#include "tracers/engine.h"
#include "tracers/scene_tree.h"
#include "transport/result.h"

#include <memory>
#include <string>

namespace sunfleck {

// What a canopy is traced with.
class Tracing {
  Stopwatch watch_;  // first, since it times what follows

 public:
  Tracing(const RadiationModel& model, const DeviceAsked& device, EngineUse use);

  SceneTree tree;
  const double build_s;  // seconds that building the tree took
  Engine engine;
  const double open_s;  // seconds that opening the device took
};

struct SimulatedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Tracing> tracing;
  RunRecord record;
  RadiationResult result;

  // Returns what its pictures are drawn from; it must outlive that.
  [[nodiscard]] Drawing drawing() const { return {*scene, tracing->tree.layout, result, tracing->engine}; }
};

// True for a run that did all the work it was asked for.
[[nodiscard]] bool is_done(StopReason stop);

}  // namespace sunfleck

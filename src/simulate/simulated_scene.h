#pragma once
// A result together with its scene, and the tree with which it is drawn.

#include "base/stopwatch.h"
#include "devices/tracers/engine.h"
#include "devices/tracers/scene_tree.h"
#include "files/results/tables/result_writer.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/model/result.h"
#include "pictures/charts/pictures.h"

#include <memory>

namespace sunfleck {

// The tree and the engine that trace a canopy.
class Tracing {
  Stopwatch watch_;  // first member, since it times the members that follow

 public:
  Tracing(const RadiationModel& model, const DeviceChoice& device, EngineUse use);

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

  // Returns the data from which its pictures are drawn; this object must outlive it.
  [[nodiscard]] Drawing drawing() const { return {*scene, tracing->tree.layout, result, tracing->engine}; }
};

}  // namespace sunfleck

#pragma once
// A canopy's tree together with the numbering of what a tracer counts in it.

#include "bvh/bvh.h"
#include "tracers/cpu_tracer.h"
#include "transport/counters.h"
#include "transport/model.h"

namespace sunfleck {

struct SceneTree {
  explicit SceneTree(const RadiationModel& model);

  CounterLayout layout;
  Bvh bvh;
};

// Returns what a tracer must know of a scene besides its tree.
[[nodiscard]] CpuTracer::Scene traced_scene(const RadiationModel& model);

}  // namespace sunfleck

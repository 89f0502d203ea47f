#pragma once
// A canopy's tree together with the numbering of what a tracer counts in it.

#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"

namespace sunfleck {

struct SceneTree {
  explicit SceneTree(const RadiationModel& model);

  CounterLayout layout;
  Bvh bvh;
};

// Returns what a tracer must know about the model besides its tree.
[[nodiscard]] TraceDomain trace_domain(const RadiationModel& model);

}  // namespace sunfleck

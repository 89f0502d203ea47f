#include "simulate/simulated_scene.h"

namespace sunfleck {

Tracing::Tracing(const RadiationModel& model, const DeviceChoice& device, EngineUse use)
    : tree(model),
      build_s(watch_.lap()),
      engine(device, tree.bvh, trace_domain(model), tree.layout.words(), use),
      open_s(watch_.lap()) {}

}  // namespace sunfleck

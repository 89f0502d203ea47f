#include "tracers/scene_tree.h"

#include "transport/scene_frame.h"

namespace sunfleck {

SceneTree::SceneTree(const RadiationModel& model)
    : layout(make_counter_layout(model)), bvh(build_bvh(model.canopy, box_padding_m(model))) {
  number_counters(layout, model.canopy, bvh);
}

CpuTracer::Scene traced_scene(const RadiationModel& model) {
  return {model.plot.periodic, model.soil.has_value()};
}

}  // namespace sunfleck

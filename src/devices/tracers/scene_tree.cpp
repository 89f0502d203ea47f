#include "devices/tracers/scene_tree.h"

#include "physics/bvh/build.h"
#include "physics/transport/model/scene_frame.h"

namespace sunfleck {

SceneTree::SceneTree(const RadiationModel& model)
    : layout(make_counter_layout(model)), bvh(build_bvh(model.canopy, box_padding_m(model))) {
  number_counters(layout, model.canopy, bvh);
}

TraceDomain trace_domain(const RadiationModel& model) {
  return {model.plot.periodic, model.soil.has_value()};
}

}  // namespace sunfleck

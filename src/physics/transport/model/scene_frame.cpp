#include "physics/transport/model/scene_frame.h"

#include <glm/common.hpp>

namespace sunfleck {

SceneBox scene_box(const RadiationModel& model) {
  const Canopy& canopy = model.canopy;
  SceneBox box;
  box.ground_y_m = -canopy.origin_m.y;
  const Box elements = bounds(canopy);
  if (!model.soil && canopy.size() > 0) box.ground_y_m = std::min(box.ground_y_m, double{elements.lo.y});
  box.lo_m = {-canopy.origin_m.x, box.ground_y_m, -canopy.origin_m.z};
  box.hi_m = box.lo_m + glm::dvec3(model.plot.size_x_m, 0.0, model.plot.size_z_m);
  if (canopy.size() > 0) {
    box.lo_m = glm::min(box.lo_m, glm::dvec3(elements.lo));
    box.hi_m = glm::max(box.hi_m, glm::dvec3(elements.hi));
  }
  box.seen_y_m = box.hi_m.y;
  for (const PlaneReceiver& plane : model.planes) box.seen_y_m = std::max(box.seen_y_m, plane.height_m - canopy.origin_m.y);
  return box;
}

float box_padding_m(const RadiationModel& model) {
  return static_cast<float>(std::ldexp(scene_box(model).extent_m(), -19));
}

}  // namespace sunfleck

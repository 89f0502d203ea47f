#include "physics/transport/indirect/emission.h"

#include "shared/emission.h"

namespace sunfleck {

PacketStart start_at(const Canopy& canopy, std::uint32_t surface, float a, float b, const EmissionFrame& frame) {
  PacketStart start;
  start.packet.element = shared::no_element;
  start.packet.image = 0;
  glm::vec3 point_m(a, frame.ground_y_m, b);
  if (surface != shared::landed_on_ground) {
    start.packet.element = surface / 2;
    const Triangle corners = canopy.corners[start.packet.element];
    point_m = shared::point_on_triangle(corners[0], corners[1], corners[2], a, b);
    start.normal = shared::normal_of_side(corners[0], corners[1], corners[2], surface % 2);
  }
  point_m = shared::point_along(point_m, start.normal, frame.offset_m);
  if (canopy.period_m.x > 0.0) {
    const shared::InPeriod moved =
        shared::moved_into_period(point_m, glm::vec2(canopy.period_m), glm::vec2(1.0 / canopy.period_m));
    point_m = moved.at;
    start.packet.image = moved.image;
  }
  start.packet.origin = point_m;
  return start;
}

}  // namespace sunfleck

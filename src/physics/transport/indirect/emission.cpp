#include "physics/transport/indirect/emission.h"

#include "physics/bvh/bvh.h"
#include "shared/emission.h"

namespace sunfleck {
namespace {

// Moves a point that may stick out of the plot back into it; sets `image` to the number of the element's copy there.
glm::vec3 wrapped(const glm::vec3& point_m, const glm::dvec2& period_m, std::uint32_t& image) {
  const shared::Wrapped x =
      shared::wrapped_into(point_m.x, static_cast<float>(period_m.x), static_cast<float>(1.0 / period_m.x));
  const shared::Wrapped z =
      shared::wrapped_into(point_m.z, static_cast<float>(period_m.y), static_cast<float>(1.0 / period_m.y));
  image = pack_image(-static_cast<int>(x.periods), -static_cast<int>(z.periods));
  return {x.at, point_m.y, z.at};
}

}  // namespace

PacketStart start_at(const Canopy& canopy, std::uint32_t surface, float a, float b, const EmissionFrame& frame) {
  PacketStart start;
  start.packet.element = shared::no_element;
  start.packet.image = 0;
  glm::vec3 point_m(a, frame.ground_y_m, b);
  if (surface != shared::landed_on_ground) {
    start.packet.element = surface / 2;
    const Triangle corners = canopy.corners[start.packet.element];
    point_m = shared::point_on_triangle(corners[0], corners[1], corners[2], a, b);
    start.normal = shared::exact_normal(corners[0], corners[1], corners[2]) * (surface % 2 == 0 ? 1.0F : -1.0F);
  }
  point_m = shared::in_front_of(point_m, start.normal, frame.offset_m);
  if (canopy.period_m.x > 0.0) point_m = wrapped(point_m, canopy.period_m, start.packet.image);
  start.packet.origin = point_m;
  return start;
}

}  // namespace sunfleck

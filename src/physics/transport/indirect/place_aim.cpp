#include "physics/transport/indirect/place_aim.h"

#include "shared/emission.h"

namespace sunfleck {

std::uint64_t PlaceAim::part(const EmissionPoint& place) const {
  glm::vec3 point_m(place.a, scene_.frame.ground_y_m, place.b);
  if (place.surface != shared::landed_on_ground) {
    const std::uint32_t element = place.surface / 2;
    if (!scene_.surfaces.at(element).soil()) return std::uint64_t{1} << 32U;
    const Triangle corners = scene_.model.canopy.corners[element];
    const glm::vec2 at = shared::middle_of(place.a, place.b);
    point_m = shared::point_on_triangle(corners[0], corners[1], corners[2], at.x, at.y);
  }
  return shared::aimed_part(stand_, point_m);
}

}  // namespace sunfleck

#include "physics/transport/indirect/place_aim.h"

namespace sunfleck {

double PlaceAim::packets_per_flux(const EmissionPoint& place) const {
  if (place.surface == shared::landed_on_ground) return aim_.packets_per_flux({place.a, scene_.frame.ground_y_m, place.b});
  const std::uint32_t element = place.surface / 2;
  if (!scene_.surfaces.at(element).soil()) return 1.0;
  const Triangle corners = scene_.model.canopy.corners[element];
  const double b = place.a == anywhere ? 1.0 / 3.0 : place.a;
  const double c = place.a == anywhere ? 1.0 / 3.0 : place.b;
  const glm::dvec3 corner(corners[0]);
  return aim_.packets_per_flux(corner + (glm::dvec3(corners[1]) - corner) * b + (glm::dvec3(corners[2]) - corner) * c);
}

}  // namespace sunfleck

#include "physics/transport/indirect/arrivals.h"

#include "physics/transport/indirect/landing_places.h"
#include "shared/beam.h"

namespace sunfleck {
namespace {

// Returns true for a ray of an isolated stand that met neither an element nor the plot's ground. Its flux counts only at the
// receivers that it passed.
bool fell_beside_plot(const IndirectScene& scene, const shared::Landing& landing, const shared::Packet& ray) {
  if (scene.model.plot.periodic || landing.surface != shared::left_downwards) return false;
  return !shared::falls_on_plot(shared::make_ray(ray.origin, ray.direction), scene.block.ground);
}

bool lies_on_lamp(const EmissionPoint& place) {
  return place.a == anywhere && place.level >= 0;
}

Arrival arrival_at(const IndirectScene& scene, const shared::Landing& landing, std::uint32_t u) {
  Arrival arrival;
  arrival.place = place_of(scene, landing);
  arrival.place.u = u;
  if (landing.surface < shared::landed_on_ground) arrival.surface = scene.surfaces.number_of[landing.surface / 2];
  if (scene.receivers != nullptr) arrival.to_zone = static_cast<std::uint32_t>(scene.receivers->zone_of(landing));
  return arrival;
}

}  // namespace

Arrival arrival_from_above(const IndirectScene& scene, const shared::Packet& ray, const shared::Landing& landing,
                           std::uint32_t u) {
  Arrival arrival = arrival_at(scene, landing, u);
  arrival.from_level = scene.layout.layers.count;
  arrival.beside_plot = fell_beside_plot(scene, landing, ray);
  if (scene.receivers != nullptr) {
    arrival.from_zone = static_cast<std::uint32_t>(scene.receivers->zone_of({shared::left_upwards, 0, 0.0F, 0.0F}));
  }
  return arrival;
}

Arrival arrival_from(const IndirectScene& scene, const EmissionPoint& source, const shared::Packet& packet,
                     const shared::Landing& landing, std::uint32_t u) {
  Arrival arrival = arrival_at(scene, landing, u);
  const bool from_lamp = lies_on_lamp(source);
  arrival.waited_level = source.level;
  arrival.from_level = from_lamp ? static_cast<int>(layer_at(scene.layout.layers, packet.origin.y)) : source.level;
  if (scene.receivers != nullptr) {
    const std::size_t waited_zone = zone_of(scene, source);
    arrival.waited_zone = static_cast<std::uint32_t>(waited_zone);
    arrival.from_zone = static_cast<std::uint32_t>(from_lamp ? scene.receivers->zone_at(packet.origin.y) : waited_zone);
  }
  return arrival;
}

std::size_t zone_of(const IndirectScene& scene, const EmissionPoint& place) {
  if (lies_on_lamp(place)) return scene.receivers->zone_of_lamps();  // as it is counted in the lowest layer
  return scene.receivers->zone_of({place.surface, place.order, place.a, place.b});
}

}  // namespace sunfleck

#include "physics/transport/indirect/packet_books.h"

#include "physics/transport/indirect/landing_points.h"
#include "shared/beam.h"

#include <algorithm>

namespace sunfleck {

PacketBooks::PacketBooks(const IndirectScene& scene)
    : scene_(scene),
      columns_(scene.lights.size() * scene.model.bands.size()),
      booked_{0, columns_},
      sums_(scene.model, scene.layout, scene.surfaces, scene.lights.size()),
      scattering_(scene.model, scene.lights.size()),
      layers_(static_cast<std::size_t>(scene.layout.layers.count) + 1, columns_),
      receivers_(scene.receivers != nullptr ? scene.receivers->size() : 0, columns_),
      scattered_(columns_) {
  if (scene.receivers != nullptr) sums_.receivers = PlaneSums(*scene.receivers, scene.model, columns_);
}

Way PacketBooks::way_from_above(const shared::Packet& ray) const {
  Way way{scene_.layout.layers.count, 0, ray};
  if (scene_.receivers != nullptr) way.from_zone = scene_.receivers->zone_of({shared::left_upwards, 0, 0.0F, 0.0F});
  return way;
}

Way PacketBooks::way_from(const EmissionPoint& place, const shared::Packet& packet) const {
  Way way{place.level, 0, packet};
  const bool from_lamp = place.a == anywhere && place.level >= 0;
  if (from_lamp) way.from_level = static_cast<int>(layer_at(scene_.layout.layers, packet.origin.y));
  if (scene_.receivers != nullptr) way.from_zone = from_lamp ? scene_.receivers->zone_at(packet.origin.y) : zone_of(place);
  return way;
}

void PacketBooks::leave(const EmissionPoint& place, std::span<const std::int64_t> quanta) {
  columns::add(quanta, layers_.taken_from(level_index(place.level)) + booked_.first);
  if (scene_.receivers != nullptr) columns::add(quanta, receivers_.taken_from(zone_of(place)) + booked_.first);
}

void PacketBooks::land(const shared::Landing& landing, const Way& way, std::uint32_t u, std::span<const std::int64_t> quanta,
                       WaitingFlux& next) {
  if (landing.surface < shared::landed_on_ground) return land_on_element(landing, way, u, quanta, next);
  if (landing.surface == shared::landed_on_ground) return land_on_soil(landing, way, u, quanta, next);
  for (std::size_t c = 0; c < quanta.size(); ++c) {
    FluxLedger& ledger = sums_.ledger[booked_.first + c];
    if (landing.surface == shared::left_upwards) ledger.reflected += quanta[c];
    if (landing.surface == shared::left_downwards) ledger.transmitted += quanta[c];
    if (landing.surface == shared::lost_on_its_way) ledger.unshot += quanta[c];
  }
  if (landing.surface == shared::lost_on_its_way) {
    ++sums_.lost;
  } else {
    pass(landing, way, landing.surface == shared::left_upwards ? scene_.layout.layers.count : -1, quanta);
  }
}

void PacketBooks::land_on_element(const shared::Landing& landing, const Way& way, std::uint32_t u,
                                  std::span<const std::int64_t> quanta, WaitingFlux& next) {
  const std::uint32_t element = landing.surface / 2;
  const std::uint32_t side = landing.surface % 2;
  const std::uint32_t surface_number = scene_.surfaces.number_of[element];
  const Surface& surface = scene_.surfaces.of[surface_number];
  const EmissionPoint place = place_of(landing, u);
  ++sums_.element_hits[element];
  sums_.side_landed.add(landing.surface, quanta, booked_.first);
  add_to(sums_.surface_landed, surface_number * 2 + side, quanta);
  if (!surface.soil()) {
    const std::size_t layer = static_cast<std::size_t>(place.level);
    add_to(sums_.layer_landed, (layer * scene_.model.optics.size() + surface.optics) * 2 + side, quanta);
  }
  scatter(place, surface.role, quanta, next);
  pass(landing, way, place.level, quanta);
}

void PacketBooks::land_on_soil(const shared::Landing& landing, const Way& way, std::uint32_t u,
                               std::span<const std::int64_t> quanta, WaitingFlux& next) {
  const EmissionPoint place = place_of(landing, u);
  add_to(sums_.cell_landed, shared::soil_cell(scene_.block.ground, {landing.place_a, landing.place_b}), quanta);
  scatter(place, Role::soil, quanta, next);
  pass(landing, way, -1, quanta);
}

void PacketBooks::scatter(const EmissionPoint& place, Role role, std::span<const std::int64_t> quanta, WaitingFlux& next) {
  const std::span<std::int64_t> scattered = std::span(scattered_).first(quanta.size());
  columns::split(quanta, scattering_.face(place.face).scattered.data() + booked_.first, place.u,
                 scattering_.absorbed(role).data() + booked_.first, scattered.data());
  if (std::all_of(scattered.begin(), scattered.end(), [](std::int64_t q) { return q == 0; })) return;
  columns::add(scattered, layers_.waiting(level_index(place.level)) + booked_.first);
  if (scene_.receivers != nullptr) columns::add(scattered, receivers_.waiting(zone_of(place)) + booked_.first);
  next.add(place, quanta);
}

// Adds a place's quanta to its sums, [place * columns + column].
void PacketBooks::add_to(std::vector<std::int64_t>& sums, std::size_t place, std::span<const std::int64_t> quanta) const {
  columns::add(quanta, &sums[place * columns_ + booked_.first]);
}

// Adds the flux that passes the planes of the layers and the receivers.
void PacketBooks::pass(const shared::Landing& landing, const Way& way, int to_level, std::span<const std::int64_t> quanta) {
  pass_receivers(landing, way, quanta);
  layers_.pass(level_index(way.from_level), level_index(to_level), quanta, booked_.first);
}

void PacketBooks::pass_receivers(const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) {
  if (scene_.receivers == nullptr) return;
  const std::size_t to_zone = scene_.receivers->zone_of(landing);
  receivers_.pass(way.from_zone, to_zone, quanta, booked_.first);
  for (std::size_t p = to_zone; p < way.from_zone; ++p) {
    const std::size_t cell = scene_.receivers->cell_at(p, way.packet.origin, way.packet.direction);
    if (cell == PlaneReceivers::no_cell) continue;
    add_to(sums_.receivers.down, cell, quanta);
  }
}

EmissionPoint PacketBooks::place_of(const shared::Landing& landing, std::uint32_t u) const {
  EmissionPoint place = sunfleck::place_of(scene_, landing);
  place.u = u;
  place.face = landing.surface == shared::landed_on_ground
                   ? scattering_.soil_face()
                   : scattering_.face_of(scene_.model.canopy.optics_of[landing.surface / 2], landing.surface % 2);
  return place;
}

std::size_t PacketBooks::zone_of(const EmissionPoint& place) const {
  if (place.a == anywhere && place.level >= 0) {  // a lamp: counted in the lowest zone, as it is in the lowest layer
    std::size_t zone = 0;
    while (zone < scene_.receivers->size() && scene_.receivers->at_ground(zone)) ++zone;
    return zone;
  }
  return scene_.receivers->zone_of({place.surface, place.order, place.a, place.b});
}

void PacketBooks::retire(std::size_t column) {
  sums_.ledger[column].unshot += layers_.drop_waiting(column);
  if (scene_.receivers != nullptr) receivers_.drop_waiting(column);
}

void PacketBooks::begin_round() {
  waited_ = layers_.count_waiting();
  if (scene_.receivers != nullptr) receivers_.count_waiting();
}

void PacketBooks::end_round() {
  const std::vector<std::int64_t> taken_along = layers_.count_taken();
  if (scene_.receivers != nullptr) receivers_.count_taken();
  for (std::size_t c = 0; c < columns_; ++c) {
    layers_.keep(c, waited_[c] - taken_along[c]);
    if (scene_.receivers != nullptr) receivers_.keep(c, waited_[c] - taken_along[c]);
  }
}

void PacketBooks::close() {
  for (std::size_t c = 0; c < columns_; ++c) retire(c);
  scattering_.add_to(sums_.ledger);
  layers_.close([](std::size_t plane) { return plane == 0; });
  sums_.down = layers_.down();
  sums_.up = layers_.up();
  if (scene_.receivers == nullptr) return;
  receivers_.close([this](std::size_t plane) { return scene_.receivers->at_ground(plane); });
  sums_.receivers.through_down = receivers_.down();
  sums_.receivers.through_up = receivers_.up();
}

}  // namespace sunfleck

// Landings of packets and sky rays: the flux they leave behind, and the planes they passed on their way.

#include "shared/beam.h"
#include "transport/indirect_round.h"

#include <algorithm>

namespace sunfleck {
namespace {

// Drawing order of the first ground cell: the ground comes after all elements, ordered by cells of its map.
constexpr std::uint32_t ground_order = 0x80000000U;

}  // namespace

EmissionPoint IndirectPass::place_of(const shared::Landing& landing) const {
  EmissionPoint place{landing.surface, landing.triangle, landing.place_a, landing.place_b, -1};
  if (landing.surface < shared::landed_on_ground) {
    const std::uint32_t element = landing.surface / 2;
    if (surfaces_.of[surfaces_.number_of[element]].soil) return place;
    const Triangle& corners = model_.canopy.corners[element];
    const float y_m = shared::landing_y(corners[0].y, corners[1].y, corners[2].y, landing.place_a, landing.place_b);
    place.level = static_cast<int>(layer_at(layout_.layers, y_m));
  } else if (landing.surface == shared::landed_on_ground) {
    place.order = ground_order + shared::soil_cell(scene_.ground, {landing.place_a, landing.place_b});
  } else if (landing.surface == shared::left_upwards) {
    place.level = layout_.layers.count;
  }
  return place;
}

std::int32_t IndirectPass::zone_of(const EmissionPoint& place) const {
  if (place.a == anywhere && place.level >= 0) {  // a lamp: counted in the lowest zone, as it is in the lowest layer
    std::int32_t zone = 0;
    while (zone < static_cast<std::int32_t>(receivers_->size()) && receivers_->at_ground(static_cast<std::size_t>(zone)))
      ++zone;
    return zone;
  }
  return receivers_->zone_of({place.surface, place.order, place.a, place.b});
}

IndirectPass::Way IndirectPass::way_from(const EmissionPoint& place, const shared::Packet& packet) const {
  Way way{place, 0, packet};
  const bool from_lamp = place.a == anywhere && place.level >= 0;
  if (from_lamp) way.from.level = static_cast<int>(layer_at(layout_.layers, packet.origin.y));
  if (receivers_ != nullptr) way.from_zone = from_lamp ? receivers_->zone_at(packet.origin.y) : zone_of(place);
  return way;
}

void IndirectPass::pass_receivers_alone(Round& round, const shared::Landing& landing, const Way& way,
                                        std::span<const std::int64_t> quanta) const {
  if (receivers_ == nullptr) return;
  pass_receivers(*receivers_, way.packet, way.from_zone, receivers_->zone_of(landing), quanta, round.sums.receivers);
}

// Adds the flux that passes the planes of the layers and the receivers.
void IndirectPass::pass(Round& round, const shared::Landing& landing, const Way& way, int to_level,
                        std::span<const std::int64_t> quanta) const {
  pass_receivers_alone(round, landing, way, quanta);
  const int from_level = way.from.level;
  if (from_level == to_level) return;
  const std::size_t bands = quanta.size();
  std::vector<std::int64_t>& planes = from_level > to_level ? round.sums.down : round.sums.up;
  const auto first = level_index(std::min(from_level, to_level));
  const auto end = level_index(std::max(from_level, to_level));
  for (std::size_t b = 0; b < bands; ++b) {
    planes[first * bands + b] += quanta[b];
    if (end * bands < planes.size()) planes[end * bands + b] -= quanta[b];
  }
}

void IndirectPass::land(Round& round, const shared::Landing& landing, const Way& way,
                        std::span<const std::int64_t> quanta) const {
  if (landing.surface < shared::landed_on_ground) return land_on_element(round, landing, way, quanta);
  if (landing.surface == shared::landed_on_ground) return land_on_soil(round, landing, way, quanta);
  for (std::size_t b = 0; b < quanta.size(); ++b) {
    FluxLedger& ledger = round.sums.ledger[b];
    if (landing.surface == shared::left_upwards) ledger.reflected += quanta[b];
    if (landing.surface == shared::left_downwards) ledger.transmitted += quanta[b];
    if (landing.surface == shared::lost_on_its_way) ledger.unshot += quanta[b];
  }
  if (landing.surface == shared::lost_on_its_way) {
    ++round.sums.lost;
  } else {
    pass(round, landing, way, landing.surface == shared::left_upwards ? layout_.layers.count : -1, quanta);
  }
}

void IndirectPass::land_on_element(Round& round, const shared::Landing& landing, const Way& way,
                                   std::span<const std::int64_t> quanta) const {
  const std::size_t bands = quanta.size();
  const std::uint32_t element = landing.surface / 2;
  const std::uint32_t side = landing.surface % 2;
  const std::uint32_t surface_number = surfaces_.number_of[element];
  const Surface& surface = surfaces_.of[surface_number];
  const SurfaceOptics& optics = model_.optics[surface.optics];
  const std::vector<FaceOptics>& face = side == 0 ? optics.upper : optics.lower;
  const EmissionPoint place = place_of(landing);
  ++round.sums.element_hits[element];
  std::fill(round.reflected.begin(), round.reflected.end(), 0);
  std::fill(round.transmitted.begin(), round.transmitted.end(), 0);
  for (std::size_t b = 0; b < bands; ++b) {
    if (quanta[b] == 0) continue;
    round.sums.side_landed[landing.surface * bands + b] += quanta[b];
    round.sums.surface_landed[(surface_number * 2 + side) * bands + b] += quanta[b];
    if (!surface.soil) {
      const std::size_t layer = static_cast<std::size_t>(place.level);
      round.sums.layer_landed[((layer * model_.optics.size() + surface.optics) * 2 + side) * bands + b] += quanta[b];
    }
    const QuantaSplit split = split_quanta(quanta[b], face[b].reflectance, face[b].transmittance, round.random.unit());
    FluxLedger& ledger = round.sums.ledger[b];
    (surface.soil ? ledger.absorbed_soil : ledger.absorbed_vegetation) += split.absorbed;
    round.reflected[b] = split.reflected;
    round.transmitted[b] = split.transmitted;
  }
  pass(round, landing, way, place.level, quanta);
  round.next.add(place, round.reflected);
  EmissionPoint other = place;
  other.surface ^= 1U;
  round.next.add(other, round.transmitted);
}

void IndirectPass::land_on_soil(Round& round, const shared::Landing& landing, const Way& way,
                                std::span<const std::int64_t> quanta) const {
  const std::size_t bands = quanta.size();
  const std::size_t cell = shared::soil_cell(scene_.ground, {landing.place_a, landing.place_b});
  std::fill(round.reflected.begin(), round.reflected.end(), 0);
  for (std::size_t b = 0; b < bands; ++b) {
    if (quanta[b] == 0) continue;
    round.sums.cell_landed[cell * bands + b] += quanta[b];
    const QuantaSplit split = split_quanta(quanta[b], model_.soil->reflectance[b], 0.0, round.random.unit());
    round.sums.ledger[b].absorbed_soil += split.absorbed;
    round.reflected[b] = split.reflected;
  }
  pass(round, landing, way, -1, quanta);
  round.next.add(place_of(landing), round.reflected);
}

}  // namespace sunfleck

#include "physics/transport/indirect/packet_starts.h"

#include "base/in_blocks.h"
#include "shared/emission.h"

namespace sunfleck {

void PacketStarts::write(std::size_t first, std::span<shared::Packet> packets) const {
  constexpr std::size_t block_size = 1024;
  each_in_blocks(
      packets.size(), block_size, [&](std::size_t p) { prefetch_start(first + p); },
      [&](std::size_t p) { packets[p] = start(first + p); });
}

void PacketStarts::prefetch_start(std::size_t packet) const {
  const std::uint32_t surface = places_.place(draw_.source(packet).place).surface;
  if (surface < shared::landed_on_ground) canopy_.corners.prefetch(surface / 2);
}

shared::Packet PacketStarts::start(std::size_t packet) const {
  const auto number = static_cast<std::uint32_t>(packet);
  const PacketSource from = draw_.source(packet);
  const EmissionPoint& place = places_.place(from.place);
  glm::vec2 at(place.a, place.b);
  if (place.a == anywhere) at = shared::weights_on_lamp(number, words_);
  const std::uint32_t surface = place.surface == shared::landed_on_ground ? place.surface : (place.surface & ~1U) | from.side;
  PacketStart start = start_at(canopy_, surface, at.x, at.y, frame_);
  start.packet.direction = shared::direction_of_packet(start.normal, number, words_);
  return start.packet;
}

}  // namespace sunfleck

#include "physics/transport/indirect/packet_starts.h"

#include "base/in_blocks.h"
#include "shared/emission.h"

namespace sunfleck {
namespace {

// Steps of the additive sequence, as parts of 2^32: the first two powers of 1 / 1.3247..., the plastic number. Places on a lamp take two
// other steps, because a sequence in four dimensions would have different ones in all of them.
constexpr std::uint32_t step_u = 0xc13fa9a9U;
constexpr std::uint32_t step_v = 0x91e10da6U;
constexpr std::uint32_t lamp_step_u = 0x9e3779b9U;
constexpr std::uint32_t lamp_step_v = 0x49d07e62U;

}  // namespace

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
  if (place.a == anywhere) at = shared::even_weights(words_.z + number * lamp_step_u, words_.w + number * lamp_step_v);
  const std::uint32_t surface = place.surface == shared::landed_on_ground ? place.surface : (place.surface & ~1U) | from.side;
  PacketStart start = start_at(canopy_, surface, at.x, at.y, frame_);
  start.packet.direction = shared::cosine_direction(start.normal, words_.x + number * step_u, words_.y + number * step_v);
  return start.packet;
}

}  // namespace sunfleck

#pragma once
// How rays and packets came to the places where they ended.

#include "physics/transport/indirect/indirect_scene.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace sunfleck {

// Where a ray or packet came from, and where it ended. Levels are those of EmissionPoint. Zones are those among the receivers,
// 0 without receivers.
struct Arrival {
  // Level at which nothing waited: that of light from above.
  static constexpr std::int32_t from_above = std::numeric_limits<std::int32_t>::max();

  EmissionPoint place;  // of a ray that left or was lost only the surface and the level
  std::int32_t waited_level = from_above;
  std::int32_t from_level = 0;  // another one for packets of a lamp, which counts at one level but is not all of it there
  std::uint32_t waited_zone = 0, from_zone = 0, to_zone = 0;
  std::uint32_t surface = 0;  // number of the element's surface; 0 elsewhere
  bool beside_plot = false;   // ends where nothing is booked but at the receivers on its way
};

// Rays or packets with what they carry.
struct ArrivalBatch {
  std::span<const shared::Packet> packets;
  std::span<const Arrival> arrivals;
  std::span<const std::int64_t> quanta;  // [ray * columns + column], in the booked columns (PacketBooks::book_only)

  [[nodiscard]] std::size_t size() const { return arrivals.size(); }
};

// Returns the arrival of a sky ray. `u` is that of EmissionPoint.
[[nodiscard]] Arrival arrival_from_above(const IndirectScene& scene, const shared::Packet& ray, const shared::Landing& landing,
                                         std::uint32_t u);

// Returns the arrival of a packet that was drawn from what waited at `source`.
[[nodiscard]] Arrival arrival_from(const IndirectScene& scene, const EmissionPoint& source, const shared::Packet& packet,
                                   const shared::Landing& landing, std::uint32_t u);

// Returns the zone in which what waits at a place is counted. The scene has receivers.
[[nodiscard]] std::size_t zone_of(const IndirectScene& scene, const EmissionPoint& place);

}  // namespace sunfleck

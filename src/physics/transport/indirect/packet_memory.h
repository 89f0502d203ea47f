#pragma once
// Memory that the rays, packets and waiting flux of a replicate take while it is made.

#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/model.h"

#include <cstddef>

namespace sunfleck {

// The numbers of rays and packets of one replicate.
struct RayCounts {
  double beam_rays = 0.0;  // from whose landings packets start
  double sky_rays = 0.0;
  double packets = 0.0;  // in the first round
};

class PacketMemory {
 public:
  explicit PacketMemory(const RadiationModel& model, std::size_t lights = 1);

  // Records at how many places flux waited in a replicate with these rays, and the memory of its sums by place. `sums` are
  // those of one light.
  void learn(const RayCounts& counts, const IndirectSums& sums);

  // Returns the peak memory of such a replicate, in bytes: an upper limit until something has been learned, then an
  // estimate from earlier replicates. It grows with the number of packets.
  [[nodiscard]] double bytes(const RayCounts& counts) const;

  // Returns the memory of its sums by place, of `most` bytes if they were all kept: an upper limit until something has been
  // learned. See PlaceSums.
  [[nodiscard]] PlaceBytes place_bytes(const RayCounts& counts, const PlaceBytes& most) const;

 private:
  std::size_t columns_, lights_;
  double lamps_;  // places present before any landing
  bool learned_ = false;
  double per_landing_;       // places per first landing
  double per_packet_ = 1.0;  // places per packet
  PlaceBytes per_packet_bytes_;
};

}  // namespace sunfleck

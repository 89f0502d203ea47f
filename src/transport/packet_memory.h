#pragma once
// How much memory the rays, packets and candidates of a replicate take while it is made.

#include "transport/indirect.h"
#include "transport/model.h"

#include <cstddef>

namespace sunfleck {

// What one replicate is made with.
struct RayCounts {
  double beam_rays = 0.0;
  double sky_rays = 0.0;
  double packets = 0.0;  // of the first round
};

class PacketMemory {
 public:
  explicit PacketMemory(const RadiationModel& model);

  // Takes note of the candidates that a replicate with these rays had.
  void learn(const RayCounts& counts, const IndirectSums& sums);

  // Returns the bytes at the peak of a replicate with those: an upper limit as long as nothing is learned, then what such a
  // replicate takes. They grow with the packets.
  [[nodiscard]] double bytes(const RayCounts& counts) const;

 private:
  std::size_t bands_;
  double lamps_;  // candidates that are there before any landing
  bool learned_ = false;
  double per_landing_ = 2.0;  // candidates that a first landing leaves
  double per_packet_ = 2.0;   // candidates that a packet leaves
};

}  // namespace sunfleck

#pragma once
// Embree as the yardstick: it gets the same references, the same rays, and the same walk from period to period.

#include "bench/stand.h"

#include "shared/layout.h"

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>

namespace sunfleck::bench {

class Peer {
 public:
  // Hands the triangles to Embree with its default settings: medium quality, not robust, and all cores for building unless
  // `threads` says otherwise. Builds nothing yet.
  explicit Peer(const Stand& stand, int threads = 0);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  // Builds Embree's tree.
  void build() const { rtcCommitScene(scene_); }

  // Follows the packets to their ends on all cores, one ray or eight rays at a time; returns how many met an element.
  [[nodiscard]] std::uint64_t follow_each(const shared::PacketBlock& scene, std::span<const shared::Packet> packets) const;
  [[nodiscard]] std::uint64_t follow_eight(const shared::PacketBlock& scene, std::span<const shared::Packet> packets) const;

 private:
  const Stand& stand_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace sunfleck::bench

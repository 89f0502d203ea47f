#pragma once
// The rays that are measured: the sun's beam, and the first packets of the indirect pass.

#include "bench/stand.h"

#include <cstdint>
#include <vector>

namespace sunfleck::bench {

// About so many beam rays: of replicate number `replicate`.
[[nodiscard]] shared::BeamBlock beam_of(const Stand& stand, double rays, std::uint64_t replicate = 0);

enum class Order {
  leaf,    // of the tree, as the solver sends packets
  random,  // each starts far from the last
};

// About so many packets as the solver's first round sends them with that seed.
[[nodiscard]] std::vector<shared::Packet> packets_of(const Stand& stand, double packets, Order order, std::uint64_t seed = 1);

// The beam as packets from nowhere, so that other tracers can take the very same rays.
[[nodiscard]] std::vector<shared::Packet> as_packets(const shared::BeamBlock& beam);

}  // namespace sunfleck::bench

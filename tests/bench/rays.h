#pragma once
// The rays that are measured: the sun's beam, and the first packets of the indirect pass.

#include "bench/stand.h"

#include <cstdint>
#include <vector>

namespace sunfleck::bench {

// One replicate of about so many beam rays.
[[nodiscard]] shared::BeamBlock beam_of(const Stand& stand, double rays);

enum class Order {
  leaf,    // of the tree, as the solver sends packets
  random,  // each starts far from the last
};

// About so many packets as the solver's first round sends them.
[[nodiscard]] std::vector<shared::Packet> packets_of(const Stand& stand, double packets, Order order);

// The beam as packets from nowhere, so that other tracers can take the very same rays.
[[nodiscard]] std::vector<shared::Packet> as_packets(const shared::BeamBlock& beam);

}  // namespace sunfleck::bench

#pragma once
// The measured rays: the sun's beam, and the first packets of the indirect pass.

#include "bench/stand.h"

#include <cstdint>
#include <vector>

namespace sunfleck::bench {

// Returns about `rays` beam rays, those of replicate number `replicate`.
[[nodiscard]] shared::BeamBlock beam_of(const Stand& stand, double rays, std::uint64_t replicate = 0);

enum class Order {
  leaf,    // in the order of the tree's leaves, as the solver sends packets
  random,  // each starts far from the previous one
};

// Returns about `packets` packets, as the solver's first round sends them with this seed.
[[nodiscard]] std::vector<shared::Packet> packets_of(const Stand& stand, double packets, Order order, std::uint64_t seed = 1);

// Returns the beam as packets that start from no element, so that other tracers can take the very same rays.
[[nodiscard]] std::vector<shared::Packet> as_packets(const shared::BeamBlock& beam);

}  // namespace sunfleck::bench

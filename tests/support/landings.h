#pragma once
// Landings of many rays or packets, compared bit by bit.

#include "physics/transport/model/tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace sunfleck::test {

using Landings = std::vector<shared::Landing>;

// Returns where the packets land.
inline Landings follow(Tracer& tracer, const shared::PacketBlock& scene, const std::vector<shared::Packet>& packets) {
  Landings landings(packets.size());
  EXPECT_EQ(tracer.trace(scene, packets, landings, {}), TraceOutcome::finished);
  return landings;
}

// Returns how many landings differ.
inline std::size_t landings_apart(const Landings& a, const Landings& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    count += std::memcmp(&a[k], &b[k], sizeof a[k]) == 0 ? 0 : 1;
  }
  return count;
}

}  // namespace sunfleck::test

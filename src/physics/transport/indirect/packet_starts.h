#pragma once
// Where the packets of a round start, and in which direction.

#include "physics/canopy/canopy.h"
#include "physics/transport/indirect/emission.h"
#include "physics/transport/indirect/packet_draw.h"
#include "physics/transport/indirect/waiting_flux.h"
#include "shared/layout.h"

#include <cstddef>
#include <glm/vec4.hpp>
#include <span>

namespace sunfleck {

// Starts the packets of a round with cosine-distributed directions. All of them form one additive sequence with a random start
// (based on the plastic number, as in canopy_view.h), which is even over the directions in space, so that neighbours in the
// drawing order complement each other.
class PacketStarts {
 public:
  // All objects must outlive the starts; the words are random.
  PacketStarts(const Canopy& canopy, const WaitingFlux& places, const PacketDraw& draw, const EmissionFrame& frame,
               const glm::uvec4& words)
      : canopy_(canopy), places_(places), draw_(draw), frame_(frame), words_(words) {}

  // Writes the packets that begin with number `first`.
  void write(std::size_t first, std::span<shared::Packet> packets) const;

 private:
  void prefetch_start(std::size_t packet) const;
  [[nodiscard]] shared::Packet start(std::size_t packet) const;

  const Canopy& canopy_;
  const WaitingFlux& places_;
  const PacketDraw& draw_;
  const EmissionFrame& frame_;
  glm::uvec4 words_;
};

}  // namespace sunfleck

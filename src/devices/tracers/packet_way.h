#pragma once
// The way of one packet on the CPU, from period to period until it lands.

#include "devices/tracers/cpu_walk.h"
#include "devices/tracers/trace_domain.h"
#include "shared/beam.h"
#include "shared/layout.h"

#include <cstdint>

namespace sunfleck {

class PacketWay {
 public:
  PacketWay() = default;  // no way

  // Begins where the packet is after that many crossings of periods, and sets the search in that period. `scene` must outlive
  // the way.
  PacketWay(const shared::PacketBlock& scene, TraceDomain domain, const shared::Packet& packet, std::uint32_t crossings,
            Search& search);
  // Begins like that before any crossing. `along` is a ray of the packet's direction.
  PacketWay(const shared::PacketBlock& scene, TraceDomain domain, const shared::Packet& packet, const shared::Ray& along,
            Search& search);

  // Takes the hit of the search; returns false if the packet has landed, else turns the search into that in the next period.
  [[nodiscard]] bool goes_on(const CpuHit& hit, Search& search);

  // Returns whether the next border that the packet reaches is x = constant.
  [[nodiscard]] bool crosses_along_x() const { return crossing_.along_x; }

  [[nodiscard]] const shared::Landing& landing() const { return landing_; }

 private:
  void look_ahead(Search& search);
  [[nodiscard]] bool land(const shared::Landing& landing);

  const shared::PacketBlock* scene_ = nullptr;
  TraceDomain domain_;
  std::uint32_t crossings_ = 0;
  bool down_ = false, over_plot_ = false;
  shared::Ground end_{};  // the soil, or the plane above the canopy
  shared::Crossing crossing_{};
  shared::Landing landing_{};
};

}  // namespace sunfleck

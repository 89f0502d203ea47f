#pragma once
// The way of one beam ray on the CPU, from period to period until it lands.

#include "devices/tracers/cpu_walk.h"
#include "devices/tracers/landing_counter.h"
#include "devices/tracers/trace_domain.h"
#include "shared/beam.h"
#include "shared/layout.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace sunfleck {

class BeamWay {
 public:
  BeamWay() = default;  // no way

  // Begins where ray number `ray` is after that many crossings of periods, and sets the search in that period. Beam and counter
  // must outlive the way.
  BeamWay(const shared::BeamBlock& beam, TraceDomain domain, const LandingCounter& landings, std::uint32_t ray,
          const glm::vec3& origin, std::uint32_t crossings, Search& search);

  // Takes the hit of the search; returns false if the ray has landed, which is then counted, else turns the search into that in
  // the next period.
  [[nodiscard]] bool goes_on(const CpuHit& hit, Search& search);

 private:
  void look_ahead(Search& search);

  const shared::BeamBlock* beam_ = nullptr;
  TraceDomain domain_;
  const LandingCounter* landings_ = nullptr;
  std::uint32_t ray_ = 0, crossings_ = 0;
  bool over_plot_ = false;
  shared::Ground ground_{};
  shared::Crossing crossing_{};
};

}  // namespace sunfleck

#pragma once
// Counts where the beam rays of one replicate end on the CPU path. Any number of threads may count in the same counters.

#include "devices/tracers/cpu_walk.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "shared/layout.h"

#include <cstdint>
#include <span>

namespace sunfleck {

class LandingCounter {
 public:
  // All of them must outlive the counter.
  LandingCounter(const Bvh& bvh, TraceDomain domain, const shared::BeamBlock& beam, std::span<std::uint32_t> counters)
      : bvh_(bvh), domain_(domain), beam_(beam), counters_(counters) {}

  void count_element(const CpuHit& hit) const;
  // Counts a ray that meets the ground at `t`.
  void count_ground(const shared::Ray& ray, float t) const;
  // Counts a ray that ends elsewhere; `counter` is one of shared::counter_missed and its neighbours.
  void count(std::uint32_t counter) const;

 private:
  const Bvh& bvh_;
  TraceDomain domain_;
  const shared::BeamBlock& beam_;
  std::span<std::uint32_t> counters_;
};

}  // namespace sunfleck

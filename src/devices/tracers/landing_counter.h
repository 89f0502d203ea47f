#pragma once
// Counts where the beam rays of one replicate end on the CPU path, and records it where that is asked for. Any number of
// threads may count in the same counters.

#include "devices/tracers/cpu_walk.h"
#include "devices/tracers/trace_domain.h"
#include "physics/bvh/bvh.h"
#include "shared/layout.h"

#include <cstdint>
#include <span>

namespace sunfleck {

class LandingCounter {
 public:
  // All of them must outlive the counter. `landings` is [ray - first_landing], or empty if they are not wanted.
  LandingCounter(const Bvh& bvh, TraceDomain domain, const shared::BeamBlock& beam, std::span<std::uint32_t> counters,
                 std::span<shared::Landing> landings, std::uint32_t first_landing = 0)
      : bvh_(bvh), domain_(domain), beam_(beam), counters_(counters), landings_(landings), first_landing_(first_landing) {}

  // Here and below, `number` is that of the ray.
  void count_element(std::uint32_t number, const CpuHit& hit) const;
  // Counts a ray that meets the ground at `t`.
  void count_ground(std::uint32_t number, const shared::Ray& ray, float t) const;
  // Counts a ray that meets neither an element nor the plot's ground, or one that is given up.
  void count_missed(std::uint32_t number) const;
  void count_lost(std::uint32_t number) const;

 private:
  void count(std::uint32_t counter) const;
  void record(std::uint32_t number, const shared::Landing& landing) const {
    if (!landings_.empty()) landings_[number - first_landing_] = landing;
  }

  const Bvh& bvh_;
  TraceDomain domain_;
  const shared::BeamBlock& beam_;
  std::span<std::uint32_t> counters_;
  std::span<shared::Landing> landings_;
  std::uint32_t first_landing_;
};

}  // namespace sunfleck

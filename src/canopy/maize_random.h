#pragma once
// The random choices of the maize generator.

#include "base/random.h"

namespace sunfleck {

struct Range {
  double lo = 0.0;
  double hi = 0.0;
};

// One stream for each (seed, plant).
class PlantRandom {
 public:
  PlantRandom(std::uint64_t seed, std::uint64_t plant) : stream_(seed, plant) {}

  // Even over [lo, hi).
  double even(Range range) { return range.lo + (range.hi - range.lo) * stream_.unit(); }

  // Bell-shaped around the middle of the range and never outside it: the mean of four even numbers, whose standard
  // deviation is (hi - lo) / sqrt(48). So ranges from the literature are kept to, and no plant is a freak.
  double around(Range range) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += even(range);
    return 0.25 * sum;
  }

  // Every whole number from lo to hi equally often.
  int whole(int lo, int hi) { return lo + static_cast<int>(stream_.word() % static_cast<std::uint64_t>(hi - lo + 1)); }

 private:
  RandomStream stream_;
};

}  // namespace sunfleck

#pragma once
// The random choices of the maize generator.

#include "base/random.h"

namespace sunfleck {

struct Range {
  double lo = 0.0;
  double hi = 0.0;
};

// Random numbers of one plant: one stream for each (seed, plant).
class PlantRandom {
 public:
  PlantRandom(std::uint64_t seed, std::uint64_t plant) : stream_(seed, plant) {}

  // Returns a number that is uniform over [lo, hi).
  double even(Range range) { return range.lo + (range.hi - range.lo) * stream_.unit(); }

  // Returns a number from a bell-shaped distribution around the middle of the range that never leaves it: the mean of four
  // uniform numbers, with standard deviation (hi - lo) / sqrt(48). This keeps to the ranges from the literature and
  // excludes outliers.
  double around(Range range) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += even(range);
    return 0.25 * sum;
  }

  // Returns a whole number from lo to hi, each equally likely.
  int whole(int lo, int hi) { return lo + static_cast<int>(stream_.word() % static_cast<std::uint64_t>(hi - lo + 1)); }

 private:
  RandomStream stream_;
};

}  // namespace sunfleck

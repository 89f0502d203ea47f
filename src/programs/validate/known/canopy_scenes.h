#pragma once
// Builds canopies of many leaves, and estimates means over many of them.

#include "physics/canopy/canopy.h"
#include "physics/transport/model/statistics.h"

#include <utility>
#include <vector>

namespace sunfleck {

// Returns 300 square leaves of 0.1 m over 1 m2, one organ each, from a generator that is easy to reproduce in other programs:
// SplitMix64, six numbers per leaf.
[[nodiscard]] Mesh explicit_leaves();

// Mean of y over random scenes, given that x has a known mean: uses x as a control variate with a fitted slope.
class KnownMean {
 public:
  explicit KnownMean(double mean_x) : mean_x_(mean_x) {}
  void add(double x, double y) { points_.emplace_back(x, y); }

  // Returns the estimate with its standard error in place of the half-width.
  [[nodiscard]] Estimate fit() const;

 private:
  double mean_x_;
  std::vector<std::pair<double, double>> points_;
};

}  // namespace sunfleck

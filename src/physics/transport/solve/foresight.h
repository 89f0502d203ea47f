#pragma once
// Forecasts of the work that remains, from the errors reached so far and how they fall.

#include "physics/transport/model/accuracy.h"

#include <cstddef>

namespace sunfleck {

// Returns how many replicates bring an error down to its bound: half-widths fall with the square root of the number of
// replicates, times Student's quantile. The result is at least `done`, the number that gave `error`, and at most `most`.
// Requires 0 <= error and 2 <= done.
[[nodiscard]] std::size_t replicates_needed(double error, double bound, double confidence, std::size_t done, std::size_t most);

// Returns the number of replicates at which to check the bounds again after a check at `done` failed and forecast that `needed`
// are needed: half of the way there, since forecasts are uncertain, but at least two replicates on. Estimating the light of
// triangles takes as long as several replicates, so that it is done less often.
[[nodiscard]] std::size_t check_after(std::size_t done, std::size_t needed, ErrorTarget of);

// The completed part of a run, as a fraction that never falls and reaches 1 only at the end.
class Completion {
 public:
  // Takes the number of replicates done and the total expected at present, and returns the completed part. Each step
  // completes its share of what was left, so a changed expectation alters the pace from here on but not the value already
  // reported.
  double update(double done, double expected);

 private:
  double left_ = 1.0;
  double done_ = 0.0;
};

}  // namespace sunfleck

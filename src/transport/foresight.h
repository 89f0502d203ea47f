#pragma once
// How much of a run is still to come, told from the errors it has reached and how they fall.

#include <cstddef>

namespace sunfleck {

// Returns how many replicates will bring an error down to its bound: half-widths fall with the root of the replicates, times
// Student's quantile. At least `done`, which reached `error`; at most `most`. 0 <= error, 2 <= done.
[[nodiscard]] std::size_t replicates_needed(double error, double bound, double confidence, std::size_t done, std::size_t most);

// The part of a run that is done, as a measure that never goes back and reaches 1 only at the end.
class Completion {
 public:
  // Takes the replicates that are done, and how many there will be in all as far as is known now. Each step takes its share of
  // what was left, so another expectation changes the pace from here on and not what has been told. Returns the part done.
  double update(double done, double expected);

 private:
  double left_ = 1.0;
  double done_ = 0.0;
};

}  // namespace sunfleck

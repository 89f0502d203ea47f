#pragma once
// True errors: runs against a reference made of a few long ones.

#include "app/tradeoff_values.h"
#include "transport/statistics.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sunfleck {

class TradeoffReference {
 public:
  // All parts are alike but for their seeds.
  void add(const RunValues& part);
  // With at least two parts. The parts' values, as run values without half-widths.
  [[nodiscard]] RunValues values() const;
  void judge_by(RunNorms norms) { norms_ = std::move(norms); }

  [[nodiscard]] std::size_t parts() const { return parts_; }
  // Its own standard error, in the same norm as errors of runs. NaN where nothing is judged.
  [[nodiscard]] double own_error(Quantity quantity) const;

  // A run's error, its half-widths being those of `replicates` replicates at that confidence: a value is covered if it and
  // the reference differ by no more than the interval of their difference. Quantities with other numbers of values than the
  // reference has (triangles of a coarser mesh) have no error.
  [[nodiscard]] QuantityError error(Quantity quantity, const QuantityValues& run, double confidence,
                                    std::size_t replicates) const;

 private:
  std::size_t parts_ = 0;
  std::array<std::vector<ReplicateMean>, 4> means_;
  RunNorms norms_;
};

// The root mean square of a setting's errors over its runs, without what the reference adds: their squares' mean less the
// square of the reference's own. NaN where less than half of that mean would be left: the reference is not fine enough to tell.
[[nodiscard]] double typical_error(const std::vector<double>& errors, double reference_error);

}  // namespace sunfleck

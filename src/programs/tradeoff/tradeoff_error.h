#pragma once
// True errors: compares runs with a reference that is the mean of a few long runs.

#include "physics/transport/model/statistics.h"
#include "programs/tradeoff/tradeoff_values.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sunfleck {

class TradeoffReference {
 public:
  // Adds one part of the reference. All parts differ only in their seeds.
  void add(const RunValues& part);
  // Returns the mean of the parts as run values without half-widths. Needs at least two parts.
  [[nodiscard]] RunValues values() const;
  void judge_by(RunNorms norms) { norms_ = std::move(norms); }

  [[nodiscard]] std::size_t parts() const { return parts_; }
  // Returns the reference's own standard error, in the same norm as the errors of runs. NaN if nothing is judged.
  [[nodiscard]] double own_error(Quantity quantity) const;

  // Returns whether the reference is exact enough to tell the error of some runs of one setting: it agrees with their mean within
  // three standard errors of both, and its own error is below their scatter.
  [[nodiscard]] bool resolves(const TradeoffReference& runs, Quantity quantity) const;

  // Returns the error of a run whose half-widths come from `replicates` replicates at that confidence. A value counts as
  // covered if it differs from the reference by no more than the confidence interval of their difference. A quantity whose
  // number of values differs from the reference's (triangles of a coarser mesh) has no error.
  [[nodiscard]] QuantityError error(Quantity quantity, const QuantityValues& run, double confidence,
                                    std::size_t replicates) const;

 private:
  std::size_t parts_ = 0;
  std::array<std::vector<ReplicateMean>, 4> means_;
  RunNorms norms_;
};

// Returns the root mean square of a setting's errors over its runs, corrected for the reference's own error: the mean of their
// squares minus the square of the reference's error. NaN if less than half of the mean would be left, since the reference is
// then not accurate enough.
[[nodiscard]] double typical_error(const std::vector<double>& errors, double reference_error);

}  // namespace sunfleck

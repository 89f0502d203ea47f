#pragma once
// Sums over several lights of one simulation, such as the steps of a date. The lights share packets, so that their errors are
// correlated: the error of a sum follows from the spread of its value between replicates.

#include "physics/transport/model/lights.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/statistics.h"
#include "physics/transport/solve/run_sums.h"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sunfleck {

class JointSums {
 public:
  explicit JointSums(LightSum sum) : sum_(std::move(sum)) {}

  // Adds the replicate that was added last to the sums of all lights.
  void add(std::span<const std::unique_ptr<RunSums>> lights);

  // Returns the half-widths; 0 for a figure on which all replicates agree.
  [[nodiscard]] JointErrors errors(double t_quantile) const;

 private:
  LightSum sum_;
  std::size_t bands_ = 0, organs_ = 0;
  std::vector<ReplicateMean> figures_;  // those of the bands, then of the organs, then of the plants
};

}  // namespace sunfleck

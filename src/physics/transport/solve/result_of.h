#pragma once
// Makes a run's result from the sums over its replicates.

#include "physics/transport/model/result.h"
#include "physics/transport/solve/run_sums.h"

namespace sunfleck {

// Returns the result of all replicates in the sums, except `stop`, `direct` and the errors, bounds and times of `indirect`.
// Throws Error (failure) if a ledger does not close.
[[nodiscard]] RadiationResult result_of(const RunSums& sums, double confidence);

// Returns the same without the arrays of elements and cells, which `copy_arrays` and `move_arrays` fill in; the latter leaves
// sums that must not be used again.
[[nodiscard]] RadiationResult figures_of(const RunSums& sums, double confidence);
void copy_arrays(const RunSums& sums, RadiationResult& result);
void move_arrays(RunSums& sums, RadiationResult& result);

}  // namespace sunfleck

#pragma once
// Makes a run's result from the sums over its replicates.

#include "physics/transport/model/result.h"
#include "physics/transport/solve/run_sums.h"

namespace sunfleck {

// Returns the result of all replicates in the sums, except `stop`, `direct` and the errors, bounds and times of `indirect`.
// Throws Error (failure) if a ledger does not close.
[[nodiscard]] RadiationResult result_of(const RunSums& sums, double confidence);

}  // namespace sunfleck

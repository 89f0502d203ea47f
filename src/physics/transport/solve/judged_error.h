#pragma once
// The errors that are compared with the bounds of a run.

#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/run_sums.h"

namespace sunfleck {

// The largest of the relative errors that a bound applies to, and the figure with that error.
struct JudgedError {
  double relative = 0.0;  // NaN below two replicates
  JudgedFigure figure;

  // Replaces the error by `other` if that is larger.
  void raise(const JudgedError& other);
};

// Returns the error that is compared with the direct bound: the largest half-width, relative to its value, of the
// first-hit flux on vegetation (taken as at least Conversion::least_share_of_vegetation of the incident flux) and on the ground
// (taken as at least 1 % of it). For organs it also includes every organ with at least a tenth of the mean organ's flux; for
// triangles it also includes the area-weighted root-mean-square half-width of the elements' irradiance, relative to its mean.
[[nodiscard]] JudgedError direct_error(const RunSums& sums, const Accuracy& accuracy);

// Returns the same for all other flux that vegetation and soil absorb, the largest over the bands; half-widths include
// the unshot flux. Vegetation's is taken as at least 1 % of all flux that it absorbs and Conversion::least_of_vegetation_w_m2,
// the soil's as at least 1 % of the incident flux.
[[nodiscard]] JudgedError indirect_error(const RunSums& sums, const Accuracy& accuracy);

}  // namespace sunfleck

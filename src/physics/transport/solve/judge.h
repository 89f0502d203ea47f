#pragma once
// Compares a series of replicates with the bounds of a run.

#include "physics/transport/model/lights.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/solve/judged_error.h"
#include "physics/transport/solve/run_triangles.h"
#include "physics/transport/solve/series.h"
#include "physics/transport/solve/solve.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sunfleck {

class Judge {
 public:
  // All arguments but the last must outlive the judge; `interrupted` ends the estimation of the light of triangles.
  Judge(Lights lights, const SolveSettings& settings, bool has_indirect, Tracer& tracer, const StopQuestion& interrupted);

  // Forgets what triangles of an earlier series showed.
  void begin_series();

  // Estimates the errors of the triangles if they are judged. Between two calls they stay the same: estimating them takes a
  // while.
  void judge_triangles(const Series& series);

  // Return the two errors of a light; empty for a pass without any light in the scene.
  [[nodiscard]] std::optional<JudgedError> direct_error_of(const Series& series, std::size_t light) const;
  [[nodiscard]] std::optional<JudgedError> indirect_error_of(const Series& series, std::size_t light) const;

  // Return the relative error of a light, 0 for a pass without any light.
  [[nodiscard]] double direct_error(const Series& series, std::size_t light) const;
  [[nodiscard]] double indirect_error(const Series& series, std::size_t light) const;

  // Return the largest error of all lights that are judged; NaN below two replicates.
  [[nodiscard]] double direct_error(const Series& series) const;
  [[nodiscard]] double indirect_error(const Series& series) const;

  [[nodiscard]] bool bounds_hold(const Series& series) const;

  // Returns how many replicates bring both errors down to their bounds, as far as the series shows.
  [[nodiscard]] std::size_t needed_replicates(const Series& series) const;

  // Returns which lights are judged, [light]: those that are bright enough.
  [[nodiscard]] const std::vector<bool>& judged() const { return judged_; }

  // Fills in the light of triangles in one light's result.
  void refine(std::size_t light, const RunSums& sums, RadiationResult& result);

 private:
  Lights lights_;
  const SolveSettings& settings_;
  bool has_indirect_;
  std::vector<bool> judged_;             // [light]
  std::vector<RunTriangles> triangles_;  // [light]
};

}  // namespace sunfleck

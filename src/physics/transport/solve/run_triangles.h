#pragma once
// The light of the triangles of a run, from sums that keep half of themselves.

#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/result.h"
#include "physics/transport/solve/judged_error.h"
#include "physics/transport/solve/run_sums.h"
#include "physics/transport/triangles/triangle_light.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace sunfleck {

// The neighbours of a canopy's triangles, found when they are first needed; all lights share them.
using LateNeighbours = std::shared_ptr<std::optional<TriangleNeighbours>>;

class RunTriangles {
 public:
  RunTriangles(Tracer& tracer, std::uint64_t seed, LateNeighbours neighbours, StopQuestion stop)
      : tracer_(tracer), seed_(seed), neighbours_(std::move(neighbours)), stop_(std::move(stop)) {}

  // Estimates the light of the triangles and keeps the errors that are compared with the bounds.
  void judge(const RunSums& sums, const Accuracy& accuracy);
  // Forgets these errors, for a series of other replicates.
  void forget() { direct_ = indirect_ = {}; }

  // Return the errors kept by judge(), 0 if there are none.
  [[nodiscard]] const JudgedError& direct_error() const { return direct_; }
  [[nodiscard]] const JudgedError& indirect_error() const { return indirect_; }

  // Fills in the light of triangles in a result that has all figures and arrays, and forgets what shadow points showed.
  void refine(const RunSums& sums, double confidence, RadiationResult& result);

 private:
  [[nodiscard]] TriangleLight estimate(const RunSums& sums, double confidence, std::span<const BeamLandings> landings,
                                       std::span<const std::int64_t> indirect, std::span<const std::int64_t> sky);

  Tracer& tracer_;
  std::uint64_t seed_;
  LateNeighbours neighbours_;
  StopQuestion stop_;
  std::optional<TriangleEstimator> estimator_;
  JudgedError direct_, indirect_;
};

}  // namespace sunfleck

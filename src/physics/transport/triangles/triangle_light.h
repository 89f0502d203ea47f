#pragma once
// The light of single elements and sides, as exact as a run and the elements' neighbourhoods allow, with honest errors.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/exposure.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/triangles/shadow_points.h"
#include "physics/transport/triangles/surface_tree.h"
#include "physics/transport/triangles/triangle_sums.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

struct TriangleLight {
  std::vector<std::int64_t> side_direct;              // [2 * element + side], in parts of a landing as in RadiationResult
  std::vector<double> direct_variance;                // [element], in landings squared
  std::vector<std::int64_t> side_indirect, side_sky;  // quanta, as in RadiationResult
  std::vector<double> indirect_variance;              // as side_indirect, in quanta squared
};

// What the light of elements is estimated from.
struct TriangleScene {
  const RadiationModel& model;
  const CounterLayout& layout;
  const Surfaces& surfaces;
  const BeamExposure& exposure;
};

// Typical relative errors of the light of the vegetation's elements: the root mean square of their half-widths, weighted by area,
// relative to their mean.
struct TriangleErrors {
  double direct = 0.0;           // of the beam's first landings; 0 without a beam
  std::vector<double> indirect;  // [band], of all other light on both sides together
};

// What the estimates in all lights of a canopy share.
struct TriangleNeighbours {
  TriangleNeighbours(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  std::vector<double> areas_m2;  // [element]; 0 where no light comes
  std::vector<SurfaceTree> trees;
};

class TriangleEstimator {
 public:
  // Neighbours and tracer must outlive the estimator, which keeps what the points showed: later scenes may differ only in the number
  // of rays.
  TriangleEstimator(const TriangleNeighbours& neighbours, Tracer& tracer, std::uint64_t seed)
      : neighbours_(neighbours), tracer_(tracer), seed_(seed) {}

  // Estimates the light of each element and side. Scattered light and sky light are pooled over neighbours (pooling.h). Of the
  // beam, points of the element are asked whether they see the sun (shadow_points.h), and their share is joined with the
  // beam's landings by the variances of both, which the scatter of the one around the other shows (beam_shares.h); if `stop` ends
  // that, the landings are pooled too. The sums over each side of a surface stay what landed there, to the last quantum.
  [[nodiscard]] TriangleLight estimate(const TriangleScene& scene, const TriangleSums& sums, const StopQuestion& stop);

 private:
  const TriangleNeighbours& neighbours_;
  Tracer& tracer_;
  std::uint64_t seed_;
  std::optional<std::vector<ElementShade>> shades_;
};

// Returns the typical errors of that light, without unshot flux.
[[nodiscard]] TriangleErrors triangle_errors(const TriangleScene& scene, const TriangleLight& light, double confidence);

// Fills in the light of the result's triangles with their errors: `side_direct`, `side_indirect`, `side_sky`, `element_error`,
// `side_error` and `triangle_relative_error`. The result needs everything but these. `unshot_shares` is what unshot flux may still
// add to light other than the beam's, relative to it, [band]; it is part of the errors.
void set_triangle_light(const TriangleScene& scene, TriangleLight light, std::span<const double> unshot_shares,
                        double confidence, RadiationResult& result);

}  // namespace sunfleck

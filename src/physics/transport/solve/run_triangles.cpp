#include "physics/transport/solve/run_triangles.h"

#include <vector>

namespace sunfleck {
namespace {

TriangleScene scene_of(const RunSums& sums) {
  const Conversion& conversion = sums.conversion;
  return {conversion.model, conversion.layout, conversion.surfaces, conversion.exposure};
}

}  // namespace

TriangleLight RunTriangles::estimate(const RunSums& sums, std::span<const BeamLandings> landings,
                                     std::span<const std::int64_t> indirect, std::span<const std::int64_t> sky) {
  const TriangleScene scene = scene_of(sums);
  if (!*neighbours_) neighbours_->emplace(scene.model, scene.layout, scene.surfaces);
  if (!estimator_) estimator_.emplace(scene, **neighbours_, tracer_, seed_);
  const std::vector<std::int64_t> half_indirect = sums.half_side_landed.all();
  const std::vector<std::int64_t> half_sky = sums.half_side_sky.all();
  const std::size_t half = (sums.replicates + 1) / 2;
  return estimator_->estimate(sums.conversion.exposure,
                              {sums.replicates, half, landings, sums.half_elements, indirect, half_indirect, sky, half_sky},
                              stop_);
}

void RunTriangles::judge(const RunSums& sums, const Accuracy& accuracy) {
  if (!sums.keeps_half || sums.replicates < 2) return;
  const TriangleLight light = estimate(sums, sums.elements, sums.side_landed.all(), sums.side_sky.all());
  const TriangleErrors errors = triangle_errors(scene_of(sums), light, accuracy.confidence);
  direct_ = {errors.direct, {.of = JudgedFigure::Of::triangles}};
  indirect_ = {};
  for (std::size_t b = 0; b < errors.indirect.size(); ++b) {
    const double unshot = sums.ledgers[b].unshot_share();
    indirect_.raise({errors.indirect[b] + unshot, {.of = JudgedFigure::Of::triangles, .band = b}});
  }
}

void RunTriangles::refine(const RunSums& sums, double confidence, RadiationResult& result) {
  if (!sums.keeps_half || sums.replicates < 2) return;
  TriangleLight light = estimate(sums, result.elements, result.side_indirect, result.side_sky);
  set_triangle_light(scene_of(sums), std::move(light), confidence, result);
  estimator_.reset();
}

}  // namespace sunfleck

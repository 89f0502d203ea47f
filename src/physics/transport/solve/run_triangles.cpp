#include "physics/transport/solve/run_triangles.h"

#include <vector>

namespace sunfleck {
namespace {

TriangleScene scene_of(const RunSums& sums) {
  const Conversion& conversion = sums.conversion;
  return {conversion.model, conversion.layout, conversion.surfaces, conversion.exposure};
}

// Returns the variance of each organ's landings in all replicates whose normal interval is that of the organ.
std::vector<double> landings_variance(const RunSums& sums, double confidence) {
  const Conversion& conversion = sums.conversion;
  const double student = t_quantile(confidence, sums.replicates);
  const double to_deviation = static_cast<double>(sums.replicates) / normal_quantile(confidence);
  std::vector<double> variances;
  for (std::size_t o = 0; o < sums.organs.size(); ++o) {
    const double landing =
        conversion.areas.organ_m2[o] > 0.0 ? conversion.ground_per_ray_m2 / conversion.areas.organ_m2[o] : 0.0;
    const double half_width = sums.organs[o].landed.estimate(student, sums.unseen(landing, confidence)).half_width;
    const double deviation = landing > 0.0 ? half_width / landing * to_deviation : 0.0;
    variances.push_back(deviation * deviation);
  }
  return variances;
}

// Returns TriangleSums::other_noise. Where none of that light has landed, it is that of independent packets.
std::vector<double> other_noise(const RunSums& sums, double confidence) {
  const Conversion& conversion = sums.conversion;
  const auto replicates = static_cast<double>(sums.replicates);
  const double to_normal = t_quantile(confidence, sums.replicates) / normal_quantile(confidence);
  const LightEvents events = sums.events(confidence);
  std::vector<double> noise;
  for (std::size_t b = 0; b < sums.bands.size(); ++b) {
    const double w_m2_per_quantum = conversion.quanta[b].w_m2_per_quantum;
    double sum = 0.0, lit = 0.0;
    for (std::size_t o = 0; o < sums.organs.size(); ++o) {
      const ReplicateMean& light = sums.organs[o].indirect[b];
      const double quanta_per_w_m2 = conversion.areas.organ_m2[o] / (w_m2_per_quantum * conversion.model.plot.area_m2());
      const double quanta = replicates * light.mean() * quanta_per_w_m2;
      if (!(quanta > 0.0)) continue;
      const double deviation = replicates * to_normal * light.standard_error() * quanta_per_w_m2;
      sum += deviation * deviation / quanta;
      lit += 1.0;
    }
    if (!(w_m2_per_quantum > 0.0)) {  // a band without light
      noise.push_back(0.0);
    } else {
      noise.push_back(lit > 0.0 ? sum / lit : events.other_w_m2(b) / w_m2_per_quantum);
    }
  }
  return noise;
}

}  // namespace

TriangleLight RunTriangles::estimate(const RunSums& sums, double confidence, std::span<const BeamLandings> landings,
                                     std::span<const std::int64_t> indirect, std::span<const std::int64_t> sky) {
  const TriangleScene scene = scene_of(sums);
  if (!*neighbours_) neighbours_->emplace(scene.model, scene.layout, scene.surfaces);
  if (!estimator_) estimator_.emplace(**neighbours_, tracer_, seed_);
  const std::vector<std::int64_t> half_indirect = sums.half_side_landed.all();
  const std::vector<std::int64_t> half_sky = sums.half_side_sky.all();
  const std::vector<double> variances = landings_variance(sums, confidence);
  const std::vector<double> noise = other_noise(sums, confidence);
  const std::size_t half = (sums.replicates + 1) / 2;
  const TriangleSums of_triangles{sums.replicates, half, landings, sums.half_elements, indirect,
                                  half_indirect,   sky,  half_sky, variances,          noise};
  return estimator_->estimate(scene, of_triangles, stop_);
}

void RunTriangles::judge(const RunSums& sums, const Accuracy& accuracy) {
  if (!sums.keeps_half || sums.replicates < 2) return;
  const TriangleLight light = estimate(sums, accuracy.confidence, sums.elements, sums.side_landed.all(), sums.side_sky.all());
  const TriangleErrors errors = triangle_errors(scene_of(sums), light, accuracy.confidence);
  direct_ = {errors.direct, {.of = JudgedFigure::Of::triangles}};
  indirect_ = {};
  for (std::size_t b = 0; b < errors.indirect.size(); ++b) {
    const double unshot = sums.unshot_share_of_scattered(b);
    indirect_.raise({errors.indirect[b] + unshot, {.of = JudgedFigure::Of::triangles, .band = b}});
  }
}

void RunTriangles::refine(const RunSums& sums, double confidence, RadiationResult& result) {
  if (!sums.keeps_half || sums.replicates < 2) return;
  TriangleLight light = estimate(sums, confidence, result.elements, result.side_indirect, result.side_sky);
  std::vector<double> unshot_shares;
  for (std::size_t b = 0; b < sums.bands.size(); ++b) unshot_shares.push_back(sums.unshot_share_of_scattered(b));
  set_triangle_light(scene_of(sums), std::move(light), unshot_shares, confidence, result);
  estimator_.reset();
}

}  // namespace sunfleck

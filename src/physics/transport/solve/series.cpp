#include "physics/transport/solve/series.h"

#include "physics/transport/solve/run_addition.h"

#include <oneapi/tbb/parallel_for.h>

namespace sunfleck {

Series::Series(const ReplicateMaker& maker, std::span<const Incidence> incidences, const SolveSettings& settings,
               const WantedSums& wanted)
    : sums(incidences.size()) {
  conversions.reserve(incidences.size());
  for (std::size_t k = 0; k < incidences.size(); ++k) {
    conversions.push_back(maker.conversion(incidences[k], k));
    light_rays.push_back(incidences[k].traced_rays);
    grid_rays += incidences[k].traced_rays;
  }
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t k) {
    sums[k] = std::make_unique<RunSums>(conversions[k], settings.element_errors, settings.shade_groups, maker.lights());
  });
  for (const LightSum& sum : wanted.of_lights) joint.emplace_back(sum, wanted.group_of_organ, front());
}

void Series::add(const ReplicateSet& replicates) {
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t k) { add_replicate(replicates[k], *sums[k]); });
  for (JointSums& sum : joint) sum.add(sums);
}

}  // namespace sunfleck

#pragma once
// What a run counted on single elements.

#include "physics/transport/model/result.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace sunfleck {

// What landed on elements in all replicates of a run, and in every other one of them.
struct TriangleSums {
  std::size_t replicates = 0, half_replicates = 0;
  std::span<const BeamLandings> landings, half_landings;  // [element]
  std::span<const std::int64_t> indirect, half_indirect;  // [(2 * element + side) * bands + band]; empty without any
  std::span<const std::int64_t> sky, half_sky;            // the part of it that comes unscattered from the sky
  // As the spread between replicates shows them: the variance of each organ's landings in all replicates, [organ], and that of its
  // other light for a quantum of it, the mean over all organs, [band].
  std::span<const double> organ_landings_variance;
  std::span<const double> other_noise;
};

}  // namespace sunfleck

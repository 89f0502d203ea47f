#pragma once
// The state of one replicate's indirect pass, used only by the source files of IndirectPass.

#include "base/random.h"
#include "transport/indirect.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sunfleck {

struct IndirectPass::Round {
  Round(const RadiationModel& model, const Surfaces& surfaces, const CounterLayout& layout, const PlaneReceivers* receivers,
        const IndirectSettings& how, const std::vector<BandQuanta>& band_quanta, const FirstLandings& first_landings);

  const IndirectSettings& settings;
  const std::vector<BandQuanta>& quanta;
  const FirstLandings& first;
  RandomStream random;
  IndirectSums sums;
  Candidates waiting, next;
  // Flux after the first landings, lamps included, [band]; the shares of a round are relative to it.
  std::vector<double> start;
  std::vector<std::int64_t> sky;                      // [band], sky flux that met something
  std::vector<std::int64_t> moved_down;               // [plane * bands + band], net flux that sampling moved through the plane
  std::vector<std::int64_t> moved_through_receivers;  // the same at the horizontal receivers
  std::vector<std::int64_t> reflected, transmitted;   // [band], of the current landing
};

// Returns the k-th ray of a systematic sample that takes one ray in `stride`. The offset is uniform over [0, 1). The last
// sum may round up to `rays`.
[[nodiscard]] inline std::uint32_t sampled_ray(std::size_t k, double offset, double stride, std::uint64_t rays) {
  return static_cast<std::uint32_t>(std::min((static_cast<double>(k) + offset) * stride, static_cast<double>(rays - 1)));
}

struct IndirectPass::Moves {
  std::vector<std::int64_t> by_level;  // [level index * bands + band]
  std::vector<std::int64_t> by_zone;   // [zone of the receivers * bands + band]; empty without receivers
};

}  // namespace sunfleck

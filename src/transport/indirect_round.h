#pragma once
// The state of one replicate's indirect pass. Only the files of IndirectPass use it.

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
  std::vector<double> start;      // [band], flux after the first landings, lamps included; a round's share is relative to it
  std::vector<std::int64_t> sky;  // [band], what came from the sky and met something
  std::vector<std::int64_t> moved_down;               // [plane * bands + band], net flux that sampling moved through it
  std::vector<std::int64_t> moved_through_receivers;  // the same for the horizontal receivers
  std::vector<std::int64_t> reflected, transmitted;   // [band], of the landing in hand
};

// The k-th ray of a systematic sample, one in `stride`; the offset is even over [0, 1). The last sum may round up to `rays`.
[[nodiscard]] inline std::uint32_t sampled_ray(std::size_t k, double offset, double stride, std::uint64_t rays) {
  return static_cast<std::uint32_t>(std::min((static_cast<double>(k) + offset) * stride, static_cast<double>(rays - 1)));
}

struct IndirectPass::Moves {
  std::vector<std::int64_t> by_level;  // [level index * bands + band]
  std::vector<std::int64_t> by_zone;   // [zone of the receivers * bands + band]; empty without them
};

}  // namespace sunfleck

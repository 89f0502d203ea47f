#pragma once
// Flux in integers.

#include "transport/model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// One band's flux in integers: a quantum is about 2^-46 of the band's incident flux per replicate.
struct BandQuanta {
  std::int64_t per_ray = 0;        // what a beam ray carries; 0 if that is less than half a quantum
  double w_m2_per_quantum = 0.0;   // of ground, in one replicate
  std::vector<std::int64_t> lamp;  // [element], what it emits in one replicate; empty without lamps in the band
  std::int64_t lamps = 0;          // their sum
  std::int64_t sky = 0;            // what all of the sky's rays carry in one replicate
};

// The most replicates of a run: more would not fit 63 bits.
inline constexpr std::size_t most_replicates = std::size_t{1} << 16U;

// The rays and packets that light travels with, in one replicate.
struct Incidence {
  std::uint64_t rays = 0;          // of the beam
  double ground_per_ray_m2 = 0.0;  // level ground that each of them stands for
  double sky_ground_m2 = 0.0;      // level ground that all of the sky's rays stand for; 0 without a sky
  double packets = 0.0;            // about as many in the first round
  std::size_t sky_rays = 0;        // about as many
};
[[nodiscard]] std::vector<BandQuanta> make_band_quanta(const RadiationModel& model, const Incidence& incidence);

}  // namespace sunfleck

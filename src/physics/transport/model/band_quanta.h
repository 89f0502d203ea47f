#pragma once
// Radiant flux counted in integer quanta.

#include "physics/transport/model/model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunfleck {

// The flux of one waveband in integers: a quantum is about 2^-46 of the band's incident flux per replicate.
struct BandQuanta {
  std::int64_t per_ray = 0;        // carried by one beam ray; 0 if that is less than half a quantum
  double w_m2_per_quantum = 0.0;   // per quantum on the ground of the plot, in one replicate
  std::vector<std::int64_t> lamp;  // [element], emitted in one replicate; empty without lamps in the band
  std::int64_t lamps = 0;          // sum of `lamp`
  std::int64_t sky = 0;            // carried by all sky rays together in one replicate
};

// The largest number of replicates in a run: the sums of more would not fit 63 bits.
inline constexpr std::size_t most_replicates = std::size_t{1} << 16U;

// The rays and packets that carry the light of one replicate.
struct Incidence {
  std::uint64_t rays = 0;            // beam rays; one of weight w (BeamPart) counts as w
  std::uint64_t traced_rays = 0;     // beam rays that are traced
  double ground_per_ray_m2 = 0.0;    // level ground represented by one beam ray of weight 1
  double sky_ground_m2 = 0.0;        // level ground represented by all sky rays together; 0 without a sky
  double packets = 0.0;              // approximate number of packets in the first round for each light
  std::size_t sky_rays = 0;          // approximate number of sky rays
  double sky_weight = 1.0;           // of the ray with the largest flux, relative to the mean
  std::uint32_t largest_weight = 1;  // of a beam ray
};
// Returns the quanta of every waveband. [waveband]
[[nodiscard]] std::vector<BandQuanta> make_band_quanta(const RadiationModel& model, const Incidence& incidence);

}  // namespace sunfleck

#pragma once
// The light of a single ray or packet. Where all replicates agree (no ray met a surface, or every ray did), their spread is
// zero, and where few events made the figure it is a poor guess. The half-widths of such figures are therefore at least what a few
// more events, or fewer, would have changed.

#include "physics/transport/model/band_quanta.h"
#include "physics/transport/model/model.h"

#include <vector>

namespace sunfleck {

// Light per event in one replicate, per ground area of the plot.
struct LightEvents {
  double beam_share = 0.0;           // share of the plot that one beam ray represents
  std::vector<double> beam_w_m2;     // [band], of one beam ray
  std::vector<double> around_w_m2;   // [band], of one beside the stand that rays are aimed at; as beam_w_m2 elsewhere
  std::vector<double> sky_w_m2;      // [band], the most that one sky ray carries
  std::vector<double> scattering;    // [band], the largest share of a landing's flux that any surface scatters
  std::vector<double> start_w_m2;    // [band], the most that waits before the first round of packets
  std::vector<double> packet_share;  // [band], the most of it that one packet carries; 0 without packets

  // Returns the most that one sky ray or packet carries; 0 in a band without such light.
  [[nodiscard]] double other_w_m2(std::size_t band) const;
  // Returns the most that any event carries.
  [[nodiscard]] double largest_w_m2(std::size_t band) const;
};

// Returns what events carry at most whatever the replicates find: all that falls on the scene lands on what scatters most.
[[nodiscard]] LightEvents make_light_events(const RadiationModel& model, const std::vector<BandQuanta>& quanta,
                                            const Incidence& incidence);

}  // namespace sunfleck

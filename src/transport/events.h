#pragma once
// What a single ray or packet brings. Where all replicates agree - a surface that nothing met, or that everything meets - their
// spread tells nothing, and the interval follows from how much a few events more or less would have changed.

#include "transport/band_quanta.h"
#include "transport/model.h"

#include <vector>

namespace sunfleck {

// Per replicate, and per ground area of the plot.
struct LightEvents {
  double beam_share = 0.0;         // share of the plot that one beam ray stands for
  std::vector<double> beam_w_m2;   // [band], of one beam ray
  std::vector<double> other_w_m2;  // [band], the most that a sky ray or a packet carries; 0 in a band without such light

  [[nodiscard]] double largest_w_m2(std::size_t band) const;
};
[[nodiscard]] LightEvents make_light_events(const RadiationModel& model, const std::vector<BandQuanta>& quanta,
                                            const Incidence& incidence);

// The largest absorptance of an optics' two faces: [optics * bands + band]; of the soil plane: [band], 0 without soil.
[[nodiscard]] std::vector<double> largest_absorptances(const RadiationModel& model);
[[nodiscard]] std::vector<double> soil_absorptances(const RadiationModel& model);

}  // namespace sunfleck

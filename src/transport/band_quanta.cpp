#include "transport/band_quanta.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {

std::vector<BandQuanta> make_band_quanta(const RadiationModel& model, const Incidence& incidence) {
  // A replicate's incident flux is about this many quanta: 2^17 replicates fit 63 bits.
  constexpr double quanta_per_replicate = 0x1p46;
  std::vector<BandQuanta> quanta(model.bands.size());
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const double per_ray_w = model.has_beam() ? model.bands[b].direct_w_m2 * incidence.ground_per_ray_m2 : 0.0;
    const double sky_w = model.bands[b].diffuse_w_m2 * incidence.sky_ground_m2;
    std::vector<double> lamp_w;
    double lamps_w = 0.0;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
      if (optics.emission_w_m2.empty() || optics.emission_w_m2[b] <= 0.0) continue;
      lamp_w.resize(model.canopy.size());
      lamp_w[e] = optics.emission_w_m2[b] * area_m2(model.canopy.corners[e]);
      lamps_w += lamp_w[e];
    }
    const double incident_w = per_ray_w * static_cast<double>(incidence.rays) + lamps_w + sky_w;
    if (!(incident_w > 0.0)) continue;
    double w_per_quantum = incident_w / quanta_per_replicate;
    if (per_ray_w > 0.0) {
      quanta[b].per_ray = std::max<std::int64_t>(1, static_cast<std::int64_t>(per_ray_w / w_per_quantum));
      w_per_quantum = per_ray_w / static_cast<double>(quanta[b].per_ray);
    }
    quanta[b].w_m2_per_quantum = w_per_quantum / model.plot.area_m2();
    quanta[b].sky = std::llround(sky_w / w_per_quantum);
    for (const double flux_w : lamp_w) quanta[b].lamp.push_back(std::llround(flux_w / w_per_quantum));
    for (const std::int64_t flux : quanta[b].lamp) quanta[b].lamps += flux;
  }
  return quanta;
}

}  // namespace sunfleck

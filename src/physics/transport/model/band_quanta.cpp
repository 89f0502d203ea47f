#include "physics/transport/model/band_quanta.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {

namespace {

// The incident flux of one replicate is about this many quanta, at most twice as many, so that 2^16 replicates fit 63 bits.
constexpr double quanta_per_replicate = 0x1p46;
// Weaker light counts as no light, because its quantum would no longer be a normal floating-point number.
constexpr double least_incident_w = 1e-290;

// Returns the whole number of quanta that a beam ray carries. It is rounded down, and the quantum is then chosen to fit. A
// beam that is so faint compared with sky and lamps that a ray would carry less than half a quantum counts as no beam: that
// drops rays * 2^-47 of the incident flux, at most 2^-19 with the largest grid. Quanta small enough to hold it would
// overflow in the sky's flux.
std::int64_t quanta_of_ray(double wanted) {
  return wanted <= 0.5 ? 0 : std::max<std::int64_t>(1, static_cast<std::int64_t>(wanted));
}

}  // namespace

std::vector<BandQuanta> make_band_quanta(const RadiationModel& model, const Incidence& incidence) {
  std::vector<BandQuanta> quanta(model.bands.size());
  const std::vector<bool> copied = copied_elements(model.canopy.copies, model.canopy.size());
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const double per_ray_w = model.has_beam() ? model.bands[b].direct_w_m2 * incidence.ground_per_ray_m2 : 0.0;
    const double sky_w = model.bands[b].diffuse_w_m2 * incidence.sky_ground_m2;
    std::vector<double> lamp_w;
    double lamps_w = 0.0;
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
      if (optics.exitance_w_m2(b) <= 0.0 || copied[e]) continue;
      lamp_w.resize(model.canopy.size());
      lamp_w[e] = optics.exitance_w_m2(b) * area_m2(model.canopy.corners[e]);
      lamps_w += lamp_w[e];
    }
    const double incident_w = per_ray_w * static_cast<double>(incidence.rays) + lamps_w + sky_w;
    if (!(incident_w > least_incident_w)) continue;
    double w_per_quantum = incident_w / quanta_per_replicate;
    quanta[b].per_ray = quanta_of_ray(per_ray_w / w_per_quantum);
    if (quanta[b].per_ray > 0) w_per_quantum = per_ray_w / static_cast<double>(quanta[b].per_ray);
    quanta[b].w_m2_per_quantum = w_per_quantum / model.plot.area_m2();
    quanta[b].sky = std::llround(sky_w / w_per_quantum);
    for (const double flux_w : lamp_w) quanta[b].lamp.push_back(std::llround(flux_w / w_per_quantum));
    for (const std::int64_t flux : quanta[b].lamp) quanta[b].lamps += flux;
  }
  return quanta;
}

}  // namespace sunfleck

#include "physics/transport/model/lights.h"

#include <algorithm>

namespace sunfleck {

std::vector<bool> bright_lights(Lights lights, double least_share) {
  std::vector<double> flux_w_m2;
  for (const RadiationModel& light : lights) {
    double flux = 0.0;
    for (const Waveband& band : light.bands) {
      flux += (light.has_beam() ? band.direct_w_m2 : 0.0) + (light.has_sky() ? band.diffuse_w_m2 : 0.0);
    }
    flux_w_m2.push_back(flux);
  }
  const double brightest = *std::max_element(flux_w_m2.begin(), flux_w_m2.end());
  std::vector<bool> bright;
  for (const double flux : flux_w_m2) bright.push_back(flux >= least_share * brightest);
  return bright;
}

bool any_beam(Lights lights) {
  return std::any_of(lights.begin(), lights.end(), [](const RadiationModel& light) { return light.has_beam(); });
}

bool any_sky(Lights lights) {
  return std::any_of(lights.begin(), lights.end(), [](const RadiationModel& light) { return light.has_sky(); });
}

}  // namespace sunfleck

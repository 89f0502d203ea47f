#include "physics/transport/model/model.h"

#include <algorithm>

namespace sunfleck {

bool RadiationModel::has_beam() const {
  const auto is_direct = [](const Waveband& band) { return band.direct_w_m2 > 0.0; };
  return sun && sun->elevation_rad > 0.0 && std::any_of(bands.begin(), bands.end(), is_direct);
}

bool RadiationModel::has_sky() const {
  return sky && std::any_of(bands.begin(), bands.end(), [](const Waveband& band) { return band.diffuse_w_m2 > 0.0; });
}

}  // namespace sunfleck

#include "physics/transport/model/surfaces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sunfleck {

Surfaces::Surfaces(const RadiationModel& model) {
  const Canopy& canopy = model.canopy;
  const ElementRoles roles = element_roles(canopy);
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> known;
  number_of.reserve(canopy.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const auto key = std::make_pair(canopy.organ_of[e], canopy.optics_of[e]);
    if (e > 0 && key == std::make_pair(canopy.organ_of[e - 1], canopy.optics_of[e - 1])) {
      number_of.push_back(number_of.back());
      continue;
    }
    const auto [place, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(of.size()));
    if (fresh) of.push_back({key.first, key.second, roles.soil[e]});
    number_of.push_back(place->second);
  }
}

bool scatters(const RadiationModel& model, std::size_t band) {
  const auto sends_on = [](const FaceOptics& face) { return face.reflectance > 0.0 || face.transmittance > 0.0; };
  if (model.soil && model.soil->reflectance[band] > 0.0) return true;
  for (const SurfaceOptics& optics : model.optics) {
    if (sends_on(optics.upper[band]) || sends_on(optics.lower[band])) return true;
    if (!optics.emission_w_m2.empty() && optics.emission_w_m2[band] > 0.0) return true;
  }
  return false;
}

bool scatters(const RadiationModel& model) {
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    if (scatters(model, b)) return true;
  }
  return false;
}

}  // namespace sunfleck

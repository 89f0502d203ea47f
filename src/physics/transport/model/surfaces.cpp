#include "physics/transport/model/surfaces.h"

#include "base/error.h"
#include "physics/transport/model/surface_roles.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace sunfleck {

Surfaces::Surfaces(const RadiationModel& model) {
  const Canopy& canopy = model.canopy;
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> known;
  number_of.reserve(canopy.size());
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const auto key = std::make_pair(canopy.organ_of[e], canopy.optics_of[e]);
    if (e > 0 && key == std::make_pair(canopy.organ_of[e - 1], canopy.optics_of[e - 1])) {
      number_of.push_back(number_of.back());
      continue;
    }
    const auto [place, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(of.size()));
    if (fresh) of.push_back({key.first, key.second});
    number_of.push_back(place->second);
  }
  set_roles(of, canopy, model.optics);
}

std::array<double, role_names.size()> area_of_roles_m2(const RadiationModel& model) {
  const Surfaces surfaces(model);
  std::array<double, role_names.size()> areas_m2{};
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    areas_m2[static_cast<std::size_t>(surfaces.at(e).role)] += area_m2(model.canopy.corners[e]);
  }
  return areas_m2;
}

std::vector<Role> organ_roles(const RadiationModel& model) {
  const Surfaces surfaces(model);
  std::vector<std::array<double, role_names.size()>> areas_m2(model.canopy.organs.size());
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const Surface& surface = surfaces.at(e);
    areas_m2[surface.organ][static_cast<std::size_t>(surface.role)] += area_m2(model.canopy.corners[e]);
  }
  std::vector<Role> roles(areas_m2.size());
  for (const Surface& surface : surfaces.of) roles[surface.organ] = surface.role;
  for (std::size_t o = 0; o < roles.size(); ++o) {
    const auto largest = std::max_element(areas_m2[o].begin(), areas_m2[o].end());
    if (*largest > 0.0) roles[o] = static_cast<Role>(largest - areas_m2[o].begin());
  }
  return roles;
}

void separate_structures(RadiationModel& model) {
  Canopy& canopy = model.canopy;
  const Surfaces surfaces(model);
  std::vector<bool> on_plants(model.optics.size());
  for (const Surface& surface : surfaces.of) {
    if (is_vegetation(surface.role)) on_plants[surface.optics] = true;
  }
  std::map<std::uint16_t, std::uint16_t> own;
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const Surface& surface = surfaces.at(e);
    const bool is_structure = surface.role == Role::structure || surface.role == Role::lamp;
    if (!is_structure || !on_plants[surface.optics]) continue;
    const auto [place, fresh] = own.try_emplace(surface.optics, static_cast<std::uint16_t>(model.optics.size()));
    if (fresh) {
      if (model.optics.size() >= std::numeric_limits<std::uint16_t>::max()) {
        throw_input(fmt::format("{} optics", model.optics.size()),
                    "structures need some of their own, and at most 65535 are possible",
                    "give surfaces of the same optics the same material");
      }
      model.optics.push_back(SurfaceOptics(model.optics[surface.optics]));
      canopy.optics_names.push_back(std::string(canopy.optics_names[surface.optics]));
    }
    canopy.optics_of[e] = place->second;
  }
}

bool scatters(const RadiationModel& model, std::size_t band) {
  const auto sends_on = [](const FaceOptics& face) { return face.reflectance > 0.0 || face.transmittance > 0.0; };
  if (model.soil && model.soil->reflectance[band] > 0.0) return true;
  for (const SurfaceOptics& optics : model.optics) {
    if (sends_on(optics.upper[band]) || sends_on(optics.lower[band])) return true;
    if (optics.exitance_w_m2(band) > 0.0) return true;
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

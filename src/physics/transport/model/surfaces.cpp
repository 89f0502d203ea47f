#include "physics/transport/model/surfaces.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace sunfleck {

namespace {

bool emits(const SurfaceOptics& optics) {
  return std::any_of(optics.emission_w_m2.begin(), optics.emission_w_m2.end(), [](double w_m2) { return w_m2 > 0.0; });
}

// The role of a surface as given, or as suggested by a name or by its emission.
struct NamedRole {
  std::optional<Role> role;
  bool is_given = false;
};

// Names the roles of surfaces; remembers what the optics' names suggest.
class RoleNames {
 public:
  explicit RoleNames(const RadiationModel& model) : model_(model) {
    for (const std::string& name : model.canopy.optics_names) of_optics_.push_back(role_from_name(name));
    of_optics_.resize(std::max(of_optics_.size(), model.optics.size()));
  }

  [[nodiscard]] NamedRole of(const Surface& surface) const {
    const Organ& organ = model_.canopy.organs[surface.organ];
    const SurfaceOptics* optics = surface.optics < model_.optics.size() ? &model_.optics[surface.optics] : nullptr;
    if (organ.role) return {organ.role, true};
    if (optics != nullptr && optics->role) return {optics->role, true};
    const std::optional<Role> by_organ = role_from_name(organ.name);
    const std::optional<Role> by_optics = of_optics_[surface.optics];
    if (by_organ == Role::soil || by_optics == Role::soil) return {Role::soil};
    if (by_organ) return {by_organ};
    if (by_optics) return {by_optics};
    if (optics != nullptr && emits(*optics)) return {Role::lamp};
    return {};
  }

 private:
  const RadiationModel& model_;
  std::vector<std::optional<Role>> of_optics_;  // [optics]
};

void set_roles(const RadiationModel& model, std::vector<Surface>& surfaces) {
  const RoleNames names(model);
  std::vector<NamedRole> named;
  std::set<std::uint32_t> plants_with_leaves;
  bool any_plant = false;
  for (const Surface& surface : surfaces) {
    const NamedRole& last = named.emplace_back(names.of(surface));
    any_plant = any_plant || !last.role || is_vegetation(*last.role);
    if (last.role == Role::leaf) plants_with_leaves.insert(model.canopy.organs[surface.organ].plant);
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const bool has_leaves = plants_with_leaves.contains(model.canopy.organs[surfaces[s].organ].plant);
    const bool is_plant = !named[s].role || (!any_plant && !named[s].is_given && named[s].role != Role::soil);
    surfaces[s].role = is_plant ? (has_leaves ? Role::stem : Role::leaf) : *named[s].role;
  }
}

}  // namespace

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
  set_roles(model, of);
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
  std::vector<Role> roles;
  for (const auto& by_role : areas_m2) {
    roles.push_back(static_cast<Role>(std::max_element(by_role.begin(), by_role.end()) - by_role.begin()));
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

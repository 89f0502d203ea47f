#include "physics/transport/model/surface_roles.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

namespace sunfleck {

namespace {

// The role of a surface as given, or as suggested by a name or by its emission.
struct NamedRole {
  std::optional<Role> role;
  bool is_given = false;
};

// Names the roles of surfaces; remembers what the optics' names suggest.
class RoleNames {
 public:
  RoleNames(const Canopy& canopy, std::span<const SurfaceOptics> optics) : canopy_(canopy), optics_(optics) {
    for (const std::string& name : canopy.optics_names) of_optics_.push_back(role_from_name(name));
    of_optics_.resize(std::max(of_optics_.size(), optics.size()));
  }

  [[nodiscard]] NamedRole of(const Surface& surface) const {
    const Organ& organ = canopy_.organs[surface.organ];
    const SurfaceOptics* optics = surface.optics < optics_.size() ? &optics_[surface.optics] : nullptr;
    if (organ.role) return {organ.role, true};
    if (optics != nullptr && optics->role) return {optics->role, true};
    const std::optional<Role> by_organ = role_from_name(organ.name);
    const std::optional<Role> by_optics = of_optics_[surface.optics];
    if (by_organ == Role::soil || by_optics == Role::soil) return {Role::soil};
    if (by_organ) return {by_organ};
    if (by_optics) return {by_optics};
    if (optics != nullptr && optics->shines()) return {Role::lamp};
    return {};
  }

 private:
  const Canopy& canopy_;
  std::span<const SurfaceOptics> optics_;
  std::vector<std::optional<Role>> of_optics_;  // [optics]
};

}  // namespace

void set_roles(std::vector<Surface>& surfaces, const Canopy& canopy, std::span<const SurfaceOptics> optics) {
  const RoleNames names(canopy, optics);
  std::vector<NamedRole> named;
  std::set<std::uint32_t> plants_with_leaves;
  bool any_plant = false;
  for (const Surface& surface : surfaces) {
    const NamedRole& last = named.emplace_back(names.of(surface));
    any_plant = any_plant || !last.role || is_vegetation(*last.role);
    if (last.role == Role::leaf) plants_with_leaves.insert(canopy.organs[surface.organ].plant);
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const bool has_leaves = plants_with_leaves.contains(canopy.organs[surfaces[s].organ].plant);
    const bool is_plant = !named[s].role || (!any_plant && !named[s].is_given && named[s].role != Role::soil);
    surfaces[s].role = is_plant ? (has_leaves ? Role::stem : Role::leaf) : *named[s].role;
  }
}

}  // namespace sunfleck

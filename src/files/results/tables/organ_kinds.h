#pragma once
// The kinds of organs in a stand, such as leaf, stem and soil, and what each kind absorbs.

#include "physics/canopy/role.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// Organs of the same name and role. All soil is one kind: the ground of [soil] and the soil elements of meshes.
struct OrganKind {
  std::string name;
  Role role = Role::leaf;
  std::size_t organs = 0;  // number of its organs; the ground of [soil] is none
  double area_m2 = 0.0;    // one-sided; of soil the area of its elements, or that of the plot if it has none
};

struct OrganKinds {
  explicit OrganKinds(const RadiationModel& model);

  std::vector<OrganKind> of;           // [kind], by role, then in the order of the canopy
  std::vector<std::size_t> number_of;  // [organ], index into `of`
  std::vector<Role> organ_roles;       // [organ]
  std::vector<double> organ_m2;        // [organ], one-sided area
};

// What a kind absorbs in one band.
struct KindFlux {
  Estimate absorbed;
  double unshot = 0.0;  // included in the half-width

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.absorbed, self.unshot);
  }
};

// Returns what each kind absorbs in one light, [kind * bands + band], W m-2 of ground. Soil and a kind that is all of the
// vegetation, or all of the structures and lamps, have the error of the flux balance. For the other kinds the random errors of
// the organs are added in quadrature, and that sum is raised by the factor by which the balance's error of all vegetation (or of
// all structures) exceeds the quadrature over its organs, if it does: it shows whether organs err in the same direction. Usually
// they do not, since what one leaf receives the next one misses, and the half-widths are then somewhat too wide. Unshot flux
// adds linearly.
[[nodiscard]] std::vector<KindFlux> absorbed_by_kinds(const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck

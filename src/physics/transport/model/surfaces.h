#pragma once
// The model's elements grouped as the solver tallies them: a surface holds the elements of one organ with the same optics.

#include "physics/canopy/role.h"
#include "physics/transport/model/model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sunfleck {

// Its role is the one given to its organ or to its optics, in this order. Otherwise it is soil if the organ or the optics have
// such a name, and else what the organ's name suggests, or the name of the optics, or a lamp if the optics emit light. A
// surface that nothing of this applies to is a leaf, or a stem if its plant has leaves. Where a canopy would consist of
// structures and lamps by their names alone, these count as leaves: there is nothing else to look at.
struct Surface {
  std::uint32_t organ = 0;
  std::uint16_t optics = 0;
  Role role = Role::leaf;

  [[nodiscard]] bool soil() const { return role == Role::soil; }
};

struct Surfaces {
  explicit Surfaces(const RadiationModel& model);

  std::vector<Surface> of;               // [surface]
  std::vector<std::uint32_t> number_of;  // [element], index into `of`

  [[nodiscard]] const Surface& at(std::size_t element) const { return of[number_of[element]]; }
};

// Returns the one-sided area of each role, m2. [role]
[[nodiscard]] std::array<double, role_names.size()> area_of_roles_m2(const RadiationModel& model);

// Returns the role of each organ: that of most of its area, or of one of its surfaces if it has no area. [organ]
[[nodiscard]] std::vector<Role> organ_roles(const RadiationModel& model);

// Gives structures and lamps optics numbers of their own, so that no number is shared by them and by vegetation: the light
// that layers absorb is counted by optics. Throws an input error if that gives too many.
void separate_structures(RadiationModel& model);

// Returns true if anything that light can meet reflects, transmits or emits in some band, so that light continues after its
// first landing.
[[nodiscard]] bool scatters(const RadiationModel& model);

// Returns true if the band's light continues after its first landing or starts on a lamp.
[[nodiscard]] bool scatters(const RadiationModel& model, std::size_t band);

}  // namespace sunfleck

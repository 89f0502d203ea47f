#pragma once
// Finds the roles of surfaces from what is given, from names and from emission; the rule is described at Surface.

#include "physics/canopy/canopy.h"
#include "physics/canopy/optics.h"
#include "physics/transport/model/surfaces.h"

#include <span>
#include <vector>

namespace sunfleck {

// Gives the canopy's surfaces the roles that they have with these optics. `optics`: [optics], named like the canopy's; may be
// empty.
void set_roles(std::vector<Surface>& surfaces, const Canopy& canopy, std::span<const SurfaceOptics> optics);

}  // namespace sunfleck

#pragma once
// The same canopy with fewer triangles.

#include "canopy/canopy.h"

namespace sunfleck {

// About `share` (0..1) of the triangles are kept, organ by organ and optics by optics, fewer corners moved than chosen: every
// corner of the result is one of the canopy's. Organs, plants and optics stay; a surface keeps its border as well as it can and
// at least one triangle. What cannot be made coarser without tearing stays as it is.
[[nodiscard]] Canopy coarsened(const Canopy& canopy, double share);

}  // namespace sunfleck

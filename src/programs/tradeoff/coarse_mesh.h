#pragma once
// Makes the same canopy with fewer triangles.

#include "physics/canopy/canopy.h"

namespace sunfleck {

// Returns the canopy with about `share` (0..1) of its triangles, simplified organ by organ and optics by optics. Corners are
// chosen among the existing ones rather than moved: every corner of the result is one of the canopy's. Organs, plants and
// optics stay; each surface keeps its border as far as possible, and at least one triangle. Surfaces that cannot be simplified
// without tearing stay as they are.
[[nodiscard]] Canopy coarsened(const Canopy& canopy, double share);

}  // namespace sunfleck

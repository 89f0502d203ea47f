#pragma once
// Builds scenes of black surfaces under the sun's beam, alone and in a plot that repeats without end.

#include "physics/light/sun.h"
#include "physics/transport/model/model.h"
#include "programs/validate/known/case_scenes.h"

namespace sunfleck {

// Returns a single inclined triangle above an isolated plot of 0.06 m.
[[nodiscard]] RadiationModel triangle_under(const SunPosition& sun);

// Return plates in a periodic plot of 1 m2 under the sun of Beijing: a level one of 0.4 x 0.3 m; one of 0.3 x 0.2 m tilted by 50
// degrees; two level ones, of which the upper one, the first organ, casts its shadow across the plot's border onto the lower one.
[[nodiscard]] RadiationModel level_plate_case();
[[nodiscard]] RadiationModel tilted_plate_case();
[[nodiscard]] RadiationModel two_plates_case();

// Returns endless strips across the sun's direction, 0.8 m wide in a period of 1 m, which span the plot along their axis or
// extend `beyond` its border on both sides.
[[nodiscard]] RadiationModel blind_under(const SunPosition& sun, double tilt_deg, double beyond);

// Returns three boards, one organ each, the top one first, with squares on every second field, over a plot of 2 x 2 m. Each has
// twice as many fields along a side as the one above it. A board shifted by half a period is its own negative, while one with
// twice as many fields repeats there. The product of the boards therefore has mean 0 however they are shifted: from any
// direction, each board halves what reaches it.
[[nodiscard]] RadiationModel checkerboards_under(const SunPosition& sun);

}  // namespace sunfleck

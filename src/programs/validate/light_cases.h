#pragma once
// Compares skies with known answers: their integrals, and the light that surfaces receive from them.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows about the irradiance that the sky models give on tilted planes and walls.
void sky_integral_cases(CaseBench& bench);

// Adds rows about the sky light that surfaces in a scene receive.
void sky_light_cases(CaseBench& bench);

}  // namespace sunfleck

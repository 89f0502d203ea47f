#pragma once
// Compares the sun's beam with known answers: on single surfaces, and in a plot that repeats without end.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows about plates and triangles under the sun.
void beam_cases(CaseBench& bench);

// Adds rows about shadows that fall across the border of a periodic plot.
void wrap_cases(CaseBench& bench);

}  // namespace sunfleck

#pragma once
// Compares the light in cavities with known answers.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows about closed boxes whose walls all emit.
void furnace_cases(CaseBench& bench);

// Adds rows about the light that leaves a bowl through its opening.
void cavity_cases(CaseBench& bench);

}  // namespace sunfleck

#pragma once
// Compares the exchange of scattered light between surfaces that see each other with known answers.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows about pairs of squares and discs with known view factors.
void view_factor_cases(CaseBench& bench);

// Adds rows about strips that see each other, or their own copies, without end.
void endless_strip_cases(CaseBench& bench);

// Adds rows about infinite plates above each other.
void parallel_plate_cases(CaseBench& bench);

// Adds rows about plates above soil, which tell reflectance from transmittance.
void plate_over_soil_cases(CaseBench& bench);

}  // namespace sunfleck

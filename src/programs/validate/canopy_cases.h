#pragma once
// Compares canopies of many leaves with known answers: the share of the beam that passes, and the fate of scattered light.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows that compare the sunlit ground and leaf area with the law of Beer and Lambert.
void random_leaf_cases(CaseBench& bench);

// Adds rows that compare a canopy of small level leaves with the two-stream equations.
void two_stream_cases(CaseBench& bench);

// Adds rows that compare a scene given leaf by leaf with an independent ray tracer.
void explicit_scene_cases(CaseBench& bench);

}  // namespace sunfleck

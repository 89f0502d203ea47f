#pragma once
// Adds one replicate to the sums of a run: its integers to the ledgers and the arrays, its fluxes to the means.

#include "physics/transport/indirect/replicate.h"
#include "physics/transport/solve/run_sums.h"

namespace sunfleck {

// Without an indirect pass the flux scattered by first landings counts as unshot, as does the sky's flux in an endless canopy.
// Throws Error (failure) if the sums over all replicates would overflow: light between mirrors can land that often.
void add_replicate(const Replicate& replicate, RunSums& sums);

}  // namespace sunfleck

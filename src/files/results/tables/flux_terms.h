#pragma once
// The fluxes of a band as results name them.

#include "physics/transport/model/result.h"

#include <array>

namespace sunfleck {

struct FluxTerm {
  const char* name;
  const char* meaning;
  Estimate BandFluxes::*flux;
};

// All but `unshot`, which has no interval of its own, in the order of JointErrors::Band.
inline constexpr std::array<FluxTerm, 6> flux_terms{
    {{"incident", "incident flux", &BandFluxes::incident},
     {"absorbed_vegetation", "flux absorbed by vegetation", &BandFluxes::absorbed_vegetation},
     {"absorbed_structure", "flux absorbed by structures and lamps", &BandFluxes::absorbed_structure},
     {"absorbed_soil", "flux absorbed by soil", &BandFluxes::absorbed_soil},
     {"reflected", "flux that leaves upwards", &BandFluxes::reflected},
     {"transmitted", "flux that leaves downwards", &BandFluxes::transmitted}}};

}  // namespace sunfleck

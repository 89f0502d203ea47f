#pragma once
// The indirect pass of one replicate: progressive Monte Carlo radiosity. Reflected, transmitted and emitted flux is shot
// round by round, from the points where it landed, until too little is left to matter.
//
// Several lights share the packets. Each packet carries quanta in every column, light times waveband, and everything that holds
// for a band holds for a column: its packets carry its own total, but for a few quanta that wait for the next round, it is
// retired by itself, and its ledger closes. Where the packets start is described in landing_points.h.

#include "physics/transport/indirect/indirect_scene.h"
#include "physics/transport/indirect/pass_arrays.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/tracer.h"

#include <optional>

namespace sunfleck {

// Shoots until every column is retired, that is, until no packet carries it, or its unshot flux is below a tenth of the order's
// bound times the smaller of the fluxes absorbed by vegetation and by soil, taken as at least least_of_vegetation and 1 % of
// the incident flux. Returns the sums of all columns, or nothing if stopped. Several threads may call this for the same scene
// if the tracer allows it.
[[nodiscard]] std::optional<IndirectSums> run_indirect_pass(const IndirectScene& scene, const ReplicateOrder& order,
                                                            const LightFromAbove& light, PassArrays& arrays,
                                                            const StopQuestion& stop);

}  // namespace sunfleck

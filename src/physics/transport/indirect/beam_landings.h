#pragma once
// The direct pass ray by ray, for scenes whose receivers need to know where each ray passed. It is slower than
// Tracer::count_beam, which records only where rays land, and gives the same counts.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Traces all beam rays of one replicate. Adds their landings to `counters` as Tracer::count_beam does, and their crossings
// of the receivers to `sums`.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout,
                                               const PlaneReceivers& planes, Tracer& tracer, const shared::BeamBlock& beam,
                                               std::span<std::uint32_t> counters, PlaneSums& sums, const StopQuestion& stop);

}  // namespace sunfleck

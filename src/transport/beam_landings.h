#pragma once
// The direct pass ray by ray, for scenes whose receivers ask where each ray passed: slower than Tracer::count_beam, which knows
// only where rays land, and with the same counts.

#include "transport/counters.h"
#include "transport/model.h"
#include "transport/planes.h"
#include "transport/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Traces all rays of one replicate, adds their landings to `counters` as Tracer::count_beam does, and what passed the receivers
// to `sums`.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout,
                                               const PlaneReceivers& planes, Tracer& tracer, const shared::BeamBlock& beam,
                                               std::span<std::uint32_t> counters, PlaneSums& sums, const StopQuestion& stop);

}  // namespace sunfleck

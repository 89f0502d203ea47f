#pragma once
// The direct pass ray by ray, for scenes whose receivers need to know where each ray passed, and for rays of other weights. It is
// slower than Tracer::count_beam and gives the same counts. Where rays are recorded, their crossings are counted afterwards.

#include "physics/transport/model/beam_block.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <span>

namespace sunfleck {

// Traces all rays of a part of the beam. Adds their weight to the counters of what they meet, as Tracer::count_beam does for
// rays of weight 1.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                               const BeamPart& part, std::span<std::uint32_t> counters,
                                               const StopQuestion& stop);

// Does the same, and adds the crossings of the receivers to `sums`; the part must have weight 1.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout,
                                               const PlaneReceivers& planes, Tracer& tracer, const shared::BeamBlock& beam,
                                               std::span<std::uint32_t> counters, PlaneSums& sums, const StopQuestion& stop);

// Adds the crossings of all rays of a beam that landed there (Tracer::record_beam), [ray]. The threads of the run share them.
void add_crossings(const RadiationModel& model, const PlaneReceivers& planes, const shared::BeamBlock& beam,
                   std::span<const shared::Landing> landings, PlaneSums& sums);

}  // namespace sunfleck

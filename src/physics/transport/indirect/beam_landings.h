#pragma once
// The direct pass of scenes whose receivers need to know where each ray passed, and of rays of other weights, which are traced one
// by one. That is slower than Tracer::count_beam and gives the same counts.

#include "physics/transport/model/beam_block.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/tracer.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sunfleck {

// Traces all rays of a part of the beam. Adds their weight to the counters of what they meet, as Tracer::count_beam does for
// rays of weight 1.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout, Tracer& tracer,
                                               const BeamPart& part, std::span<std::uint32_t> counters,
                                               const StopQuestion& stop);

// Does what Tracer::count_beam does, and adds the crossings of the receivers to `sums`. Where each ray landed is recorded in
// `recorded` if the tracer can do that, and `records` says that there is memory; else nothing is left there.
[[nodiscard]] TraceOutcome count_beam_landings(const RadiationModel& model, const CounterLayout& layout,
                                               const PlaneReceivers& planes, Tracer& tracer, const shared::BeamBlock& beam,
                                               bool records, std::span<std::uint32_t> counters,
                                               std::vector<shared::Landing>& recorded, PlaneSums& sums,
                                               const StopQuestion& stop);

}  // namespace sunfleck

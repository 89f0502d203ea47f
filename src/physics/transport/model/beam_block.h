#pragma once
// The beam rays of one replicate.

#include "physics/light/beam_grid.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "shared/layout.h"

#include <cstdint>

namespace sunfleck {

// Returns the grid of about `rays` beam rays over the plot, or around an isolated stand. The model must have a beam.
[[nodiscard]] BeamGrid make_grid(const RadiationModel& model, const CounterLayout& layout, double rays);

// Returns one replicate's beam rays in the form that tracers take; `rays` is their approximate number.
[[nodiscard]] shared::BeamBlock make_beam_block(const RadiationModel& model, const CounterLayout& layout, double rays,
                                                std::uint64_t seed, std::uint64_t replicate);

}  // namespace sunfleck

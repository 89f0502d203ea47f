#pragma once
// The beam rays of one replicate.

#include "physics/light/beam_grid.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/stand_aim.h"
#include "shared/beam.h"
#include "shared/layout.h"

#include <cstdint>
#include <vector>

namespace sunfleck {

// Returns one replicate's beam rays in the form that tracers take; `rays` is their approximate number.
[[nodiscard]] shared::BeamBlock make_beam_block(const RadiationModel& model, const CounterLayout& layout, double rays,
                                                std::uint64_t seed, std::uint64_t replicate);

// Returns a ray of the beam as a packet, which lands where the ray does.
[[nodiscard]] inline shared::Packet beam_packet(const shared::BeamBlock& beam, std::uint32_t ray) {
  return {shared::beam_origin(beam, ray), shared::no_element, beam.direction, 0};
}

// Beam rays that each carry the flux of `weight` rays of the replicate's first part.
struct BeamPart {
  shared::BeamBlock block;
  std::uint32_t weight = 1;

  [[nodiscard]] std::uint64_t rays() const { return std::uint64_t{block.columns} * block.rows; }
};

// Returns the grids of all beam rays, the first with weight 1 and about `rays` of them. `aim` may be null: there is then one grid,
// over the plot or around an isolated stand. The model must have a beam.
[[nodiscard]] std::vector<WeightedBeamGrid> make_grids(const RadiationModel& model, const CounterLayout& layout,
                                                       const StandAim* aim, double rays);

// Returns one replicate's beam rays on these grids. The first part does not depend on the presence of others.
[[nodiscard]] std::vector<BeamPart> make_beam_parts(const RadiationModel& model, const CounterLayout& layout,
                                                    const StandAim* aim, double rays, std::uint64_t seed,
                                                    std::uint64_t replicate);

}  // namespace sunfleck

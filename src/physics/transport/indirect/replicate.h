#pragma once
// One replicate: its order, and the sums that it contributes to the result.

#include "physics/transport/indirect/place_sums.h"
#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/surfaces.h"
#include "physics/transport/receivers/planes.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sunfleck {

// Landings of one replicate's beam rays, summed from its counters.
struct DirectSums {
  std::vector<std::uint32_t> hit;          // elements with landings, in ascending order
  std::vector<BeamLandings> surface;       // [surface]
  std::vector<BeamLandings> layer_optics;  // [layer * optics + optics], without soil
  std::vector<double> organ_lit_m2;        // [organ]
  std::vector<double> layer_lit_m2;        // [layer], foliage
  std::vector<double> plant_lit_m2;        // [plant of PlantAreas], foliage
  std::uint64_t soil_plane = 0, transmitted = 0, ground = 0, met = 0, missed = 0, lost = 0;
};

// Quanta carried by one replicate's sky rays and packets. The `landed` arrays count all flux that arrived, before it is
// split. The sums of a single light have a column for each band; those of several have one for each band and light (column_of).
struct IndirectSums {
  IndirectSums() = default;  // without any place
  IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, std::size_t lights = 1);

  // Passes every sum to `archive`.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.surface_landed, self.layer_landed, self.side_landed, self.element_hits, self.cell_landed, self.side_sky,
            self.cell_sky, self.down, self.up, self.ledger, self.sky_landed, self.first_waiting, self.receivers, self.sky_rays,
            self.packets, self.rounds, self.first_places, self.most_places, self.lost);
  }

  std::size_t bands = 0;                     // number of columns
  std::vector<std::int64_t> surface_landed;  // [(surface * 2 + side) * bands + band]
  std::vector<std::int64_t> layer_landed;    // [((layer * optics + optics) * 2 + side) * bands + band], without soil
  PlaceSums side_landed;                     // [(2 * element + side) * bands + band]
  std::vector<std::uint32_t> element_hits;   // [element], packets that landed on either side; empty if not asked for
  PlaceSums cell_landed;                     // [cell of the soil's map * bands + band]
  PlaceSums side_sky;                        // as side_landed, sky rays only; empty without a sky
  PlaceSums cell_sky;                        // as cell_landed, sky rays only
  std::vector<std::int64_t> down, up;        // [plane * bands + band], through the planes of the layers, top plane last
  std::vector<FluxLedger> ledger;            // [band]; `incident` holds flux from the lamps and the sky
  std::vector<std::int64_t> sky_landed;      // [band], by sky rays
  std::vector<std::int64_t> first_waiting;   // [band], what waits before the first round
  PlaneSums receivers;                       // at the horizontal receivers, if there are any
  std::uint64_t sky_rays = 0, packets = 0, rounds = 0, lost = 0;
  // Number of places with waiting flux before the first round, and the largest number after a round.
  std::uint64_t first_places = 0, most_places = 0;

  static constexpr PlaceSums IndirectSums::*by_place[] = {&IndirectSums::side_landed, &IndirectSums::side_sky,
                                                          &IndirectSums::cell_landed, &IndirectSums::cell_sky};
};

// Returns the sums of each light out of those of all. Numbers of rays, packets and hits are the same for each. [light]
[[nodiscard]] std::vector<IndirectSums> sums_by_light(IndirectSums joint, std::size_t lights, const PlaceMemory& memory);

// The sums that one replicate contributes to a run in one light.
struct Replicate {
  // Passes everything to `archive` but `direct`, which follows from the counters.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.counters, self.passed, self.direct_s, self.indirect_s);
    if (self.packets) archive(*self.packets);
  }

  std::vector<std::uint32_t> counters;  // numbered as in physics/transport/model/counters.h
  DirectSums direct;
  PlaneSums passed;                     // receivers that the beam rays passed
  std::optional<IndirectSums> packets;  // empty without an indirect pass
  double direct_s = 0.0;                // wall time, including the wait for the tracer
  double indirect_s = 0.0;
};

// One replicate in all lights of a simulation. [light]
using ReplicateSet = std::vector<Replicate>;

// Describes one replicate. Replicates with the same seed and number are identical, whatever else is made at the same time.
struct ReplicateOrder {
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.beam_rays, self.aimed, self.packets, self.sky_rays, self.bound, self.seed, self.number, self.sampled_rays,
            self.ray_shares, self.counts_hits);
  }

  // Returns the approximate number of rays of one light's beam.
  [[nodiscard]] double rays_of(std::size_t light) const {
    return ray_shares.empty() ? beam_rays : ray_shares[light] * beam_rays;
  }

  double beam_rays = 0.0;    // approximate number, of the first part if there are several
  bool aimed = false;        // if the scene has a StandAim, light is aimed at the stand
  double packets = 0.0;      // in the first round; 0: no indirect pass
  std::size_t sky_rays = 0;  // if there is a sky
  double bound = 0.003;      // of the indirect pass; its stop rule leaves a tenth of it unshot
  std::uint64_t seed = 1;
  std::uint64_t number = 0;
  // Largest number of beam rays from whose landings packets start; there is also at most one for each packet.
  double sampled_rays = std::numeric_limits<double>::infinity();
  std::vector<double> ray_shares;  // [light], of beam_rays; empty where each light has all of them
  bool counts_hits = false;        // whether IndirectSums::element_hits is counted
};

}  // namespace sunfleck

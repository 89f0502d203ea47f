#pragma once
// The indirect pass of one replicate: progressive Monte Carlo radiosity. Reflected, transmitted and emitted flux is shot
// round by round, from the points where it landed, until too little is left to matter.

#include "bvh/bvh.h"
#include "transport/accuracy.h"
#include "transport/band_quanta.h"
#include "transport/candidates.h"
#include "transport/counters.h"
#include "transport/model.h"
#include "transport/planes.h"
#include "transport/result.h"
#include "transport/sky_rays.h"
#include "transport/surfaces.h"
#include "transport/tracer.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sunfleck {

// Quanta carried by one replicate's sky rays and packets. The `landed` arrays count all flux that arrived, before it is
// split.
struct IndirectSums {
  IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  std::size_t bands;
  std::vector<std::int64_t> surface_landed;  // [(surface * 2 + side) * bands + band]
  std::vector<std::int64_t> layer_landed;    // [((layer * optics + optics) * 2 + side) * bands + band], without soil
  std::vector<std::int64_t> side_landed;     // [(2 * element + side) * bands + band]
  std::vector<std::uint32_t> element_hits;   // [element], packets that landed on either side
  std::vector<std::int64_t> cell_landed;     // [cell of the soil's map * bands + band]
  std::vector<std::int64_t> side_sky;        // as side_landed, sky rays only; empty without a sky
  std::vector<std::int64_t> cell_sky;        // as cell_landed, sky rays only
  std::vector<std::int64_t> down, up;        // [plane * bands + band], through the planes of the layers, top plane last
  std::vector<FluxLedger> ledger;            // [band]; `incident` holds flux from the lamps and the sky
  PlaneSums receivers;                       // at the horizontal receivers, if there are any
  std::uint64_t sky_rays = 0, packets = 0, rounds = 0, lost = 0;
  // Number waiting before the first round, and the largest number waiting after a round.
  std::uint64_t first_candidates = 0, most_candidates = 0;
};

// The results of one replicate's direct pass that the indirect pass starts from.
struct FirstLandings {
  const shared::BeamBlock* beam = nullptr;  // null without direct light
  std::uint64_t rays = 0;
  std::uint64_t met = 0;  // number of those rays that met anything
  // Quanta waiting where they landed, [(level + 1) * bands + band]; `level` as in EmissionPoint, so index 0 is the soil
  // and index 1 the lowest layer.
  std::vector<std::int64_t> scattered;
  // The same by zones of the receivers, [zone * bands + band]; empty without receivers.
  std::vector<std::int64_t> scattered_by_zone;
};

struct IndirectSettings {
  double packets = 65536;    // in the first round
  std::size_t sky_rays = 0;  // if there is a sky
  double bound = 0.003;      // the stop rule leaves a tenth of it unshot
  std::uint64_t seed = 1;
  std::uint64_t replicate = 0;
};

class IndirectPass {
 public:
  // All arguments must outlive the pass; `sky` and `receivers` may be null.
  IndirectPass(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer,
               const SkyRays* sky, const PlaneReceivers* receivers);

  // Shoots until every band is retired, that is, until its unshot flux is below a tenth of the bound times the smaller of
  // the fluxes absorbed by vegetation and by soil, each taken as at least 1 % of the incident flux. Returns nothing if
  // stopped. Several threads may run replicates concurrently if the tracer allows it.
  [[nodiscard]] std::optional<IndirectSums> run(const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                                const IndirectSettings& settings, const StopQuestion& stop) const;

 private:
  struct Round;
  // A side that the light of a sampled beam ray leaves, and the optics of the face on which it landed.
  struct Source {
    EmissionPoint place;
    const std::vector<FaceOptics>* face = nullptr;  // null for the soil plane
    bool transmitted = false;

    [[nodiscard]] double weight(const Soil* soil, std::size_t band) const {
      if (face == nullptr) return soil != nullptr ? soil->reflectance[band] : 0.0;
      return transmitted ? (*face)[band].transmittance : (*face)[band].reflectance;
    }
  };
  // Net quanta shot from each level and zone: flux shot there minus flux that waited there.
  struct Moves;
  // The start and the ray that lead to a landing.
  struct Way {
    EmissionPoint from;
    std::int32_t from_zone = 0;
    const shared::Packet& packet;
  };

  [[nodiscard]] bool let_sky_in(Round& round, const StopQuestion& stop) const;
  [[nodiscard]] std::optional<std::vector<Source>> sample_first_landings(Round& round, const StopQuestion& stop) const;
  void add_first_candidates(Round& round, const std::vector<Source>& sources) const;
  void add_lamps(Round& round) const;
  [[nodiscard]] bool shoot(Round& round, const StopQuestion& stop) const;
  void keep_undrawn(Round& round, const Draw& draw) const;
  [[nodiscard]] Moves moved_by(const Round& round, const Draw& draw) const;
  void book(Round& round, const Moves& moves) const;
  void close_planes(Round& round) const;
  void retire_faint_bands(Round& round) const;
  [[nodiscard]] std::vector<double> expected_draws(const Round& round) const;

  void land(Round& round, const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) const;
  void land_on_element(Round& round, const shared::Landing& landing, const Way& way,
                       std::span<const std::int64_t> quanta) const;
  void land_on_soil(Round& round, const shared::Landing& landing, const Way& way, std::span<const std::int64_t> quanta) const;
  void pass(Round& round, const shared::Landing& landing, const Way& way, int to_level,
            std::span<const std::int64_t> quanta) const;
  void pass_receivers_alone(Round& round, const shared::Landing& landing, const Way& way,
                            std::span<const std::int64_t> quanta) const;
  [[nodiscard]] bool fell_beside_plot(const shared::Landing& landing, const shared::Packet& ray) const;
  [[nodiscard]] EmissionPoint place_of(const shared::Landing& landing) const;
  [[nodiscard]] std::int32_t zone_of(const EmissionPoint& place) const;
  [[nodiscard]] Way way_from(const EmissionPoint& place, const shared::Packet& packet) const;

  const RadiationModel& model_;
  const CounterLayout& layout_;
  const Surfaces& surfaces_;
  Tracer& tracer_;
  const SkyRays* sky_;
  const PlaneReceivers* receivers_;
  shared::PacketBlock scene_;
  EmissionFrame frame_;
};

// Returns the scene in the form that tracers take for packets.
[[nodiscard]] shared::PacketBlock make_packet_block(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck

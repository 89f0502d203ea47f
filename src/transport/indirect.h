#pragma once
// The indirect pass of one replicate: progressive Monte Carlo radiosity. Flux that was reflected, transmitted or emitted is
// shot on, round by round, from the very points where it landed, until too little is left to matter.

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

// What one replicate's sky rays and packets did, in quanta. Landed counts all that arrived, whatever became of it.
struct IndirectSums {
  IndirectSums(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces);

  std::size_t bands;
  std::vector<std::int64_t> surface_landed;  // [(surface * 2 + side) * bands + band]
  std::vector<std::int64_t> layer_landed;    // [((layer * optics + optics) * 2 + side) * bands + band], without soil
  std::vector<std::int64_t> side_landed;     // [(2 * element + side) * bands + band]
  std::vector<std::uint32_t> element_hits;   // [element], packets that landed on either side
  std::vector<std::int64_t> cell_landed;     // [cell of the soil's map * bands + band]
  std::vector<std::int64_t> side_sky;        // as side_landed, of the sky's rays alone; empty without a sky
  std::vector<std::int64_t> cell_sky;        // as cell_landed
  std::vector<std::int64_t> down, up;        // [plane * bands + band], through the layers' planes, top plane last
  std::vector<FluxLedger> ledger;            // [band]; incident: what the lamps emitted and what came from the sky
  PlaneSums receivers;                       // of the horizontal receivers, if there are any
  std::uint64_t sky_rays = 0, packets = 0, rounds = 0, lost = 0;
  std::uint64_t first_candidates = 0, most_candidates = 0;  // that waited before the first round, and at most after a round
};

// What the direct pass leaves behind in one replicate.
struct FirstLandings {
  const shared::BeamBlock* beam = nullptr;  // none without direct light
  std::uint64_t rays = 0;
  std::uint64_t met = 0;                        // of them, those that met anything
  std::vector<std::int64_t> scattered;          // [(level + 1) * bands + band], quanta that wait where they landed; level as in
                                                // EmissionPoint: 0 is the soil's, 1 the lowest layer's place
  std::vector<std::int64_t> scattered_by_zone;  // [zone of the receivers * bands + band], the same; empty without them
};

struct IndirectSettings {
  double packets = 65536;    // of the first round
  std::size_t sky_rays = 0;  // if there is a sky
  double bound = 0.003;      // the stop rule leaves a tenth of it unshot
  std::uint64_t seed = 1;
  std::uint64_t replicate = 0;
};

class IndirectPass {
 public:
  // All must outlive it; `sky` and `receivers` may be null.
  IndirectPass(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces, Tracer& tracer,
               const SkyRays* sky, const PlaneReceivers* receivers);

  // Shoots until every band is retired: its unshot flux is below a tenth of the bound times the smaller of what vegetation
  // and soil absorbed of it, each taken as at least 1 % of the incident flux. None if stopped. Several threads may run
  // replicates side by side, if the tracer may be used so.
  [[nodiscard]] std::optional<IndirectSums> run(const FirstLandings& first, const std::vector<BandQuanta>& quanta,
                                                const IndirectSettings& settings, const StopQuestion& stop) const;

 private:
  struct Round;
  // A side that a sampled beam ray's light leaves, and the face it landed on.
  struct Source {
    EmissionPoint place;
    const std::vector<FaceOptics>* face = nullptr;  // none: the soil plane
    bool transmitted = false;

    [[nodiscard]] double weight(const Soil* soil, std::size_t band) const {
      if (face == nullptr) return soil != nullptr ? soil->reflectance[band] : 0.0;
      return transmitted ? (*face)[band].transmittance : (*face)[band].reflectance;
    }
  };
  // Quanta by where they are: what is shot from there less what waited.
  struct Moves;
  // How flux comes to a landing.
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

// The scene as packets see it.
[[nodiscard]] shared::PacketBlock make_packet_block(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck

#pragma once
// Sums over the replicates of a run: integers for the ledger, means and spreads for the rest.

#include "physics/transport/indirect/conversion.h"
#include "physics/transport/indirect/replicate.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/lights.h"
#include "physics/transport/model/result.h"
#include "physics/transport/model/statistics.h"
#include "physics/transport/receivers/planes.h"
#include "physics/transport/solve/shade_classes.h"

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace sunfleck {

struct BandMeans {                                                    // W m-2 of ground
  ReplicateMean incident;                                             // of an isolated stand; 0 in an endless canopy
  ReplicateMean vegetation, structure, soil, reflected, transmitted;  // total flux absorbed or leaving
  ReplicateMean indirect_vegetation, indirect_soil;                   // absorbed flux except from the beam's first landings
};

struct OrganMeans {
  ReplicateMean landed, sunlit;  // landed: ground area of the beam rays per organ area
  std::vector<ReplicateMean> direct, indirect, absorbed, indirect_absorbed;  // [band], W m-2 of organ
};

struct PlantMeans {
  ReplicateMean sunlit;                           // of its leaf area that the beam can hit
  std::vector<ReplicateMean> incident, absorbed;  // [band], W
};

struct LayerMeans {
  ReplicateMean ratio, sunlit;
  std::vector<ReplicateMean> down, up, absorbed, absorbed_structure;  // [band], W m-2 of ground
};

// The sum of one value per replicate, and of its squares.
struct Spread {
  double sum = 0.0, squares = 0.0;

  void add(double value) {
    sum += value;
    squares += value * value;
  }
  // Returns the half-width of the interval of the mean.
  [[nodiscard]] double half_width(double t_quantile, std::size_t replicates) const;
};

struct RunSums {
  // All replicates have the incidence of `conversion`, which must outlive the sums. `lights` are those of the simulation, if it
  // has more than that one.
  RunSums(const Conversion& conversion, ElementErrors element_errors, ShadeGroups shade_groups = ShadeGroups::all,
          Lights lights = {});

  // Returns how much the events that may have escaped all replicates would add to a mean if each adds `event` in its
  // replicate.
  [[nodiscard]] double unseen(double event, double confidence) const;

  // Returns the conversion's events, where packets carry no more than what waited for them and what may have escaped all
  // replicates.
  [[nodiscard]] LightEvents events(double confidence) const;

  // Returns the unshot flux of a replicate, W m-2 of ground.
  [[nodiscard]] double unshot_w_m2(std::size_t band) const;
  // Returns what unshot flux may still add to any figure of light other than the beam's, relative to the figure. It need not wait
  // where the light that was shot came from: that is twice the share of unshot flux in all that waited.
  [[nodiscard]] double unshot_share_of_scattered(std::size_t band) const;

  // Return the half-widths of what elements absorb, [band * elements + element], and of the irradiance of their sides, as
  // side_spread; NaN where too few rays and packets came to tell. Empty unless the spreads are kept.
  [[nodiscard]] std::vector<double> element_errors(double t_quantile) const;
  [[nodiscard]] std::vector<double> side_errors(double t_quantile) const;

  // Passes every sum to `archive`, which writes those of const sums and fills others. The number of values depends only on
  // the lights and on the element errors: zeros are passed for arrays that are empty before the first replicate.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive);

  const Conversion& conversion;
  bool has_sky, has_packets;  // in any of the lights
  bool keeps_half = false;
  std::size_t replicates = 0;
  std::uint64_t lost = 0, sky_rays = 0, packets = 0, rounds = 0;
  // [band], quanta: of packets and sky rays, counted once per landing; of sky rays alone; what waited before the first rounds
  std::vector<double> landed, sky_landed, first_waiting;
  ReplicateMean first_vegetation, first_ground, met, ground_ratio, sunlit;
  std::vector<FluxLedger> ledgers;  // [band]
  std::vector<BandMeans> bands;
  std::vector<OrganMeans> organs;
  std::vector<PlantMeans> plants;  // [plant of PlantAreas]
  std::vector<LayerMeans> layers;  // [layer, + 1 for the top plane]
  ShadeClasses classes;
  std::vector<BeamLandings> elements;  // [element]
  // As in IndirectSums, over all replicates; empty before the first.
  PlaceSums side_landed, side_sky, cell_landed, cell_sky;
  std::vector<std::uint64_t> soil_cells;
  // As `elements`, side_landed and side_sky, over every other replicate from the first on; empty unless the light of triangles
  // is to be estimated.
  std::vector<BeamLandings> half_elements;
  PlaceSums half_side_landed, half_side_sky;
  std::vector<std::uint64_t> element_hits;  // [element], rays and packets; empty if errors are skipped
  std::vector<Spread> direct_spread;        // [element], landings; this and the next two are empty if errors are skipped
  std::vector<Spread> absorbed_spread;      // [band * elements + element], W m-2 of element
  std::vector<Spread> indirect_spread;      // [band * elements + element], W m-2 of element
  std::vector<Spread> side_spread;          // [(2 * element + side) * bands + band], W m-2 of element; empty unless kept
  std::optional<PlaneTally> planes;
};

template <class Self, class Archive>
void RunSums::visit(Self& self, Archive& archive) {
  archive(self.replicates, self.lost, self.sky_rays, self.packets, self.rounds, self.landed, self.sky_landed,
          self.first_waiting, self.first_vegetation, self.first_ground, self.met, self.ground_ratio, self.sunlit);
  for (auto& ledger : self.ledgers) {
    archive(ledger.incident, ledger.absorbed_vegetation, ledger.absorbed_structure, ledger.absorbed_soil, ledger.reflected,
            ledger.transmitted, ledger.unshot);
  }
  for (auto& band : self.bands) {
    archive(band.incident, band.vegetation, band.structure, band.soil, band.reflected, band.transmitted,
            band.indirect_vegetation, band.indirect_soil);
  }
  for (auto& organ : self.organs) {
    archive(organ.landed, organ.sunlit, organ.direct, organ.indirect, organ.absorbed, organ.indirect_absorbed);
  }
  for (auto& plant : self.plants) archive(plant.sunlit, plant.incident, plant.absorbed);
  for (auto& layer : self.layers)
    archive(layer.ratio, layer.sunlit, layer.down, layer.up, layer.absorbed, layer.absorbed_structure);
  archive(self.classes);
  for (auto& element : self.elements) archive(element.upper, element.lower);
  const RadiationModel& model = self.conversion.model;
  const auto visit_places = [&](auto& sums, std::size_t size) {
    if constexpr (!std::is_const_v<Self>) sums = PlaceSums(size / model.bands.size(), model.bands.size());
    archive(sums);
    std::int64_t none = 0;
    for (std::size_t k = sums.size(); k < size; ++k) archive(none);
  };
  const std::size_t sides = 2 * self.elements.size() * model.bands.size();
  const std::size_t cells = self.soil_cells.size() * model.bands.size();
  visit_places(self.side_landed, self.has_packets ? sides : 0);
  visit_places(self.cell_landed, self.has_packets ? cells : 0);
  visit_places(self.side_sky, self.has_sky ? sides : 0);
  visit_places(self.cell_sky, self.has_sky ? cells : 0);
  for (auto& element : self.half_elements) archive(element.upper, element.lower);
  visit_places(self.half_side_landed, self.has_packets && self.keeps_half ? sides : 0);
  visit_places(self.half_side_sky, self.has_sky && self.keeps_half ? sides : 0);
  archive(self.soil_cells, self.element_hits);
  for (auto* spreads : {&self.direct_spread, &self.absorbed_spread, &self.indirect_spread, &self.side_spread}) {
    for (auto& spread : *spreads) archive(spread.sum, spread.squares);
  }
  if (self.planes) archive(*self.planes);
}

}  // namespace sunfleck

#pragma once
// What a simulation found out. Fluxes are per ground area of the plot unless said otherwise; every estimate carries the
// half-width of its confidence interval.

#include "transport/counters.h"
#include "transport/statistics.h"
#include "transport/tracer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Where one band's flux went, in integer quanta. Each term is tallied by itself; the sum of the others is `incident`.
struct FluxLedger {
  std::int64_t incident = 0;
  std::int64_t absorbed_vegetation = 0;
  std::int64_t absorbed_soil = 0;
  std::int64_t reflected = 0;
  std::int64_t transmitted = 0;
  std::int64_t unshot = 0;

  // What is missing from the sum.
  [[nodiscard]] std::int64_t residual() const {
    return incident - (absorbed_vegetation + absorbed_soil + reflected + transmitted + unshot);
  }
};

// W m-2 of ground. The half-widths hold the unshot flux: it may still end up in any of the four.
struct BandResult {
  std::string name;
  FluxLedger ledger;
  double incident = 0.0;
  double unshot = 0.0;
  Estimate absorbed_vegetation, absorbed_soil, reflected, transmitted;
};

// W m-2 of the organ's one-sided area. In these and all finer figures the half-width of `absorbed` holds unshot flux in
// proportion: as much of it as of what the canopy absorbed.
struct OrganResult {
  double area_m2 = 0.0;
  Estimate sunlit_fraction;        // share of its area in direct sun
  std::vector<Estimate> direct;    // [waveband], of the beam, incident on both faces
  std::vector<Estimate> indirect;  // [waveband], of all other light, incident on both faces
  std::vector<Estimate> absorbed;  // [waveband]
};

// A layer, and the horizontal plane at its lower edge. Soil elements count as lying below every plane.
struct LayerResult {
  double height_m = 0.0;  // lower edge; of the last entry: the top plane
  double leaf_area_index = 0.0;
  Estimate sunfleck_ratio;         // share of the plane that the direct beam reaches
  Estimate sunlit_leaf_fraction;   // NaN without leaf area in the layer
  std::vector<Estimate> down, up;  // [waveband], W m-2 through the plane
  std::vector<Estimate> absorbed;  // [waveband], W m-2 of ground, by elements other than soil
};

// Landings of beam rays on one element, over all replicates.
struct ElementResult {
  std::uint64_t upper = 0;
  std::uint64_t lower = 0;
};

// A horizontal receiver's map. Cells are numbered x fastest; the sums over cells are the flux through the whole plane.
struct PlaneResult {
  double height_m = 0.0;
  std::uint32_t cells_x = 0, cells_z = 0;
  std::vector<std::uint64_t> reached;   // [cell], beam rays that came down through it
  std::vector<std::uint64_t> crossing;  // [cell], beam rays whose way, extended, crosses it: reached if nothing stood above
  std::vector<std::int64_t> down;       // [cell * bands + band], quanta of all other light that came down through it
  Estimate sunfleck_ratio;              // share of the plane that the direct beam reaches; value NaN without a beam
  std::vector<Estimate> total_down;     // [band], W m-2 of plane, beam and all other light
};

// What one point of a sensor reads, W m-2.
struct SensorResult {
  std::vector<Estimate> direct, sky, scattered;  // [band]; direct is exact: a point sees the sun or does not
};

// What one replicate is made of: rays of the beam, packets of the first round.
struct Work {
  double rays = 0.0;
  double packets = 0.0;
};

// A figure whose error a bound judges.
struct JudgedFigure {
  enum class Of { vegetation, soil, organ, triangles };
  Of of = Of::vegetation;
  std::size_t organ = 0;            // if it is an organ's
  std::optional<std::size_t> band;  // none: the beam's landings, alike in all bands
};

struct PassSummary {
  std::uint64_t rays = 0;
  std::size_t replicates = 0;
  double grid_m = 0.0;                   // root of plot area over rays
  std::optional<double> relative_error;  // what is compared with the bound
  std::optional<JudgedFigure> judged;    // whose error that is: the largest of all; none without a beam
  std::optional<double> bound;           // none if the work was fixed
  double seconds = 0.0;
};

struct IndirectSummary {
  std::uint64_t sky_rays = 0;
  std::uint64_t packets = 0;
  std::uint64_t rounds = 0;  // over all replicates
  std::optional<double> relative_error;
  std::optional<JudgedFigure> judged;
  std::optional<double> bound;
  double seconds = 0.0;
};

enum class StopReason { bound_reached, work_done, rays_spent, replicates_spent, time_spent, interrupted };

struct RadiationResult {
  StopReason stop = StopReason::work_done;
  std::vector<BandResult> bands;
  std::vector<OrganResult> organs;          // [organ of the canopy]
  std::vector<LayerResult> layers;          // [layer, bottom first, + 1 for the top plane]
  std::vector<ElementResult> elements;      // [element]
  std::vector<double> element_error;        // [waveband * elements + element], W m-2, of absorbed; empty unless asked for
  std::vector<double> side_error;           // [(2 * element + side) * bands + band], W m-2, of incident; empty unless asked for
  std::vector<std::uint64_t> soil_cells;    // [cell of the soil's map], landings of beam rays
  std::vector<std::int64_t> side_indirect;  // [(2 * element + side) * bands + band], quanta of other light; empty if none
  std::vector<std::int64_t> cell_indirect;  // [cell * bands + band]
  std::vector<std::int64_t> side_sky;       // as side_indirect: its part that comes from the sky unscattered; empty without sky
  std::vector<std::int64_t> cell_sky;       // as cell_indirect
  std::vector<PlaneResult> planes;          // [plane of the model]
  std::vector<std::vector<SensorResult>> sensors;  // [sensor of the model][point]
  std::vector<double> w_per_quantum;               // [waveband], W that one of these quanta stands for
  Estimate sunlit_leaf_fraction;
  Estimate ground_sunfleck_ratio;  // value NaN without a beam
  double leaf_area_index = 0.0;
  double ground_per_ray_m2 = 0.0;  // level ground that one landing stands for: irradiance follows from it
  std::uint64_t lost_rays = 0;
  PassSummary direct;
  IndirectSummary indirect;
  Work work;       // of each replicate
  Work next_work;  // with which a run on a scene much like this one would begin, its bounds the same

  // Irradiance (W m-2) of a side, or of a cell of the soil's map, by all but the beam; 0 without area.
  [[nodiscard]] double side_indirect_w_m2(std::size_t side, double area_m2, std::size_t band) const {
    return indirect_w_m2(side_indirect, side, area_m2, band);
  }
  [[nodiscard]] double cell_indirect_w_m2(std::size_t cell, double area_m2, std::size_t band) const {
    return indirect_w_m2(cell_indirect, cell, area_m2, band);
  }

  // The part of side_indirect_w_m2 that comes from the sky unscattered.
  [[nodiscard]] double side_sky_w_m2(std::size_t side, double area_m2, std::size_t band) const {
    return indirect_w_m2(side_sky, side, area_m2, band);
  }
  [[nodiscard]] double cell_sky_w_m2(std::size_t cell, double area_m2, std::size_t band) const {
    return indirect_w_m2(cell_sky, cell, area_m2, band);
  }

  // Irradiance (W m-2) that `landings` make on `area_m2` in a band of that horizontal beam irradiance; 0 without area.
  [[nodiscard]] double irradiance_w_m2(std::uint64_t landings, double area_m2, double beam_w_m2) const {
    return area_m2 > 0.0 ? static_cast<double>(landings) * ground_per_ray_m2 * beam_w_m2 / area_m2 : 0.0;
  }

 private:
  [[nodiscard]] double indirect_w_m2(const std::vector<std::int64_t>& quanta, std::size_t place, double area_m2,
                                     std::size_t band) const {
    if (quanta.empty() || !(area_m2 > 0.0)) return 0.0;
    return static_cast<double>(quanta[place * w_per_quantum.size() + band]) * w_per_quantum[band] / area_m2;
  }
};

}  // namespace sunfleck

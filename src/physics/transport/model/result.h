#pragma once
// The results of a simulation. Fluxes are per ground area of the plot unless stated otherwise; every estimate carries the
// half-width of its confidence interval.

#include "physics/canopy/role.h"
#include "physics/transport/model/statistics.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The fate of one band's flux, in integer quanta. Each term is tallied by itself; `incident` must equal the sum of the
// others.
struct FluxLedger {
  std::int64_t incident = 0;
  std::int64_t absorbed_vegetation = 0;
  std::int64_t absorbed_structure = 0;  // by structures and lamps
  std::int64_t absorbed_soil = 0;
  std::int64_t reflected = 0;
  std::int64_t transmitted = 0;
  std::int64_t unshot = 0;

  // Returns the term of what surfaces of that role absorb.
  [[nodiscard]] std::int64_t& absorbed_by(Role role) {
    if (role == Role::soil) return absorbed_soil;
    return is_vegetation(role) ? absorbed_vegetation : absorbed_structure;
  }

  [[nodiscard]] std::int64_t absorbed() const { return absorbed_vegetation + absorbed_structure + absorbed_soil; }

  // Returns the part of `incident` that the other terms do not account for.
  [[nodiscard]] std::int64_t residual() const { return incident - (absorbed() + reflected + transmitted + unshot); }

  // Returns the flux that may still be absorbed, relative to the flux absorbed.
  [[nodiscard]] double unshot_share() const {
    return absorbed() > 0 ? static_cast<double>(unshot) / static_cast<double>(absorbed()) : 0.0;
  }
};

// The fluxes of one band, W m-2 of ground. The half-widths of all but the incident flux include the unshot flux, which could still
// end up in any of the five other terms. That of the incident flux is 0 on an endless canopy; on an isolated stand rays count what
// arrives.
struct BandFluxes {
  Estimate incident{0.0, 0.0};
  Estimate absorbed_vegetation;
  Estimate absorbed_structure{0.0, 0.0};  // by structures and lamps; exactly 0 without any
  Estimate absorbed_soil, reflected, transmitted;
  double unshot = 0.0;

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.incident, self.absorbed_vegetation, self.absorbed_structure, self.absorbed_soil, self.reflected,
            self.transmitted, self.unshot);
  }
};

// The flux balance of one band.
struct BandResult : BandFluxes {
  std::string name;
  FluxLedger ledger;
};

// The sunlit and the shaded part of an organ, of the leaves in a layer, or of all leaves; one-sided areas. Triangles that no
// light can reach are in neither.
struct ShadeClassResult {
  Estimate sunlit_m2, shaded_m2;
  // [waveband], W m-2 of the class's own area, absorbed by both faces; NaN unless the class is known to
  // have an area
  std::vector<Estimate> absorbed_sunlit, absorbed_shaded;
  // [waveband], W m-2, standard deviation over the class's area of what its places absorb per area; noise is no part of it
  std::vector<Estimate> sunlit_sd, shaded_sd;
};

// The light of one organ, W m-2 of its one-sided area. Here and in all finer figures the half-width of `absorbed` includes
// unshot flux in proportion to what was absorbed, with the canopy's ratio of unshot to absorbed flux.
struct OrganResult {
  double area_m2 = 0.0;
  Estimate sunlit_fraction;        // share of its area in direct sun
  std::vector<Estimate> direct;    // [waveband], beam incident on both faces
  std::vector<Estimate> indirect;  // [waveband], all other light incident on both faces
  std::vector<Estimate> absorbed;  // [waveband]
  ShadeClassResult classes;
};

// The light of one plant's leaves, stems and fruits, W of the whole plant.
struct PlantResult {
  std::uint32_t plant = 1;
  glm::dvec3 position_m{0.0};        // as in PlantSite
  double height_m = 0.0;             // from its lowest to its highest point
  double leaf_area_m2 = 0.0;         // one-sided
  Estimate sunlit_leaf_fraction;     // NaN without leaves that the beam can hit
  std::vector<Estimate> incident_w;  // [waveband], all light on both faces
  std::vector<Estimate> absorbed_w;  // [waveband]
};

// A layer, and the horizontal plane at its lower edge. Soil elements count as lying below every plane.
struct LayerResult {
  double height_m = 0.0;  // of the lower edge; in the last entry, of the top plane
  double leaf_area_index = 0.0;
  // Share of the plane that the direct beam reaches; for an isolated stand, of the beam that meets the stand or its plot.
  Estimate sunfleck_ratio;
  Estimate sunlit_leaf_fraction;   // NaN without leaf area in the layer
  std::vector<Estimate> down, up;  // [waveband], W m-2 through the plane
  // [waveband], W m-2 of ground, by the vegetation and by the structures and lamps in the layer
  std::vector<Estimate> absorbed, absorbed_structure;
  ShadeClassResult leaf_classes;  // empty in the top plane
};

// The half-widths of a sum over several lights of one simulation, without unshot flux, in the figures' units times that of the
// weights.
struct JointErrors {
  struct Band {
    double incident = 0.0, vegetation = 0.0, structure = 0.0, soil = 0.0, reflected = 0.0, transmitted = 0.0;

    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive) {
      archive(self.incident, self.vegetation, self.structure, self.soil, self.reflected, self.transmitted);
    }
  };

  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive(self.bands, self.organs, self.plants, self.groups, self.planes);
  }

  std::vector<Band> bands;     // [band], arriving, absorbed by these or leaving, W m-2 of ground
  std::vector<double> organs;  // [organ * bands + band], absorbed, W m-2 of organ
  std::vector<double> plants;  // [plant * bands + band], absorbed, W of the plant
  std::vector<double> groups;  // [group * bands + band], absorbed by the organs of a group, W m-2 of ground
  std::vector<double> planes;  // [plane * bands + band], through a receiver downwards, W m-2
};

// Landings of beam rays on the two sides of an element or a surface.
struct BeamLandings {
  std::uint64_t upper = 0;
  std::uint64_t lower = 0;

  [[nodiscard]] std::uint64_t both() const { return upper + lower; }
  [[nodiscard]] std::uint64_t side(std::size_t number) const { return number == 0 ? upper : lower; }

  BeamLandings& operator+=(const BeamLandings& more) {
    upper += more.upper;
    lower += more.lower;
    return *this;
  }
};

// The map of a horizontal receiver. Cells are numbered x fastest; the sums over the cells are the flux through the whole
// plane.
struct PlaneResult {
  double height_m = 0.0;
  std::uint32_t cells_x = 0, cells_z = 0;
  std::vector<std::uint64_t> reached;  // [cell], beam rays that came down through it
  // [cell], beam rays whose extended line crosses it: those that would reach it if nothing stood above.
  std::vector<std::uint64_t> crossing;
  std::vector<std::int64_t> down;    // [cell * bands + band], quanta of all other light that came down through it
  Estimate sunfleck_ratio;           // share of the plane that the direct beam reaches; value NaN without a beam
  std::vector<Estimate> total_down;  // [band], W m-2 of plane, beam and all other light
};

// The reading at one point of a sensor, or the mean over its points, W m-2.
struct SensorResult {
  std::vector<Estimate> direct, sky, scattered;  // [band]; `direct` is exact: a point sees the sun or does not
  std::vector<Estimate> total;                   // [band], their sum
};

// The size of one replicate: rays of the beam, packets of the first round.
struct Work {
  double rays = 0.0;
  double packets = 0.0;
};

// A figure whose error is compared with a bound.
struct JudgedFigure {
  enum class Of { vegetation, soil, organ, triangles, sensor };
  Of of = Of::vegetation;
  std::size_t organ = 0;            // for Of::organ
  std::size_t sensor = 0;           // for Of::sensor
  std::optional<std::size_t> band;  // empty: the beam's landings, which are the same in all bands
};

// The error of a pass and the time it took.
struct PassError {
  std::optional<double> relative_error;  // error that is compared with the bound, the largest of all figures
  std::optional<JudgedFigure> judged;    // figure with that error; empty without a beam
  std::optional<double> bound;           // empty if the work was fixed
  double seconds = 0.0;
};

struct PassSummary : PassError {
  std::uint64_t rays = 0;
  std::size_t replicates = 0;
  double grid_m = 0.0;  // square root of plot area over rays
};

struct IndirectSummary : PassError {
  std::uint64_t sky_rays = 0;
  std::uint64_t packets = 0;
  std::uint64_t rounds = 0;  // over all replicates
};

// The error is that of a sensor's total, for a line of the mean of its points.
struct SensorSummary : PassError {
  std::uint32_t rays = 0;      // for sky light and for scattered light each, from every point in every replicate
  std::size_t replicates = 0;  // of the sensor that has most
};

enum class StopReason { bound_reached, work_done, rays_spent, replicates_spent, time_spent, interrupted };

// Returns whether a run did all the requested work.
[[nodiscard]] constexpr bool is_done(StopReason stop) {
  return stop == StopReason::bound_reached || stop == StopReason::work_done;
}

struct RadiationResult {
  static constexpr std::int64_t parts_per_landing = 1 << 16;  // in side_direct

  StopReason stop = StopReason::work_done;
  std::vector<BandResult> bands;
  std::vector<OrganResult> organs;     // [organ of the canopy]
  std::vector<PlantResult> plants;     // [plant with vegetation], ascending by number
  std::vector<LayerResult> layers;     // [layer, bottom first, + 1 for the top plane]
  std::vector<BeamLandings> elements;  // [element], over all replicates
  std::vector<double> element_error;   // [waveband * elements + element], W m-2, of absorbed flux; empty unless requested
  std::vector<double> side_error;      // [(2 * element + side) * bands + band], W m-2, of incident flux; empty unless requested
  std::vector<std::uint64_t> soil_cells;  // [cell of the soil's map], landings of beam rays
  // [(2 * element + side) * bands + band], quanta of all other light; empty without any.
  std::vector<std::int64_t> side_indirect;
  // [2 * element + side], parts of landings of beam rays, whose sums over each side of a surface are those of `elements`; empty
  // unless the light of triangles was estimated (refines(ElementErrors)) or without a beam. side_indirect and side_sky are then
  // estimates in the same way.
  std::vector<std::int64_t> side_direct;
  // [band], typical relative error of what a triangle of the vegetation absorbs: the root mean square of the half-widths,
  // weighted by area, relative to the mean. Empty unless estimated.
  std::vector<double> triangle_relative_error;
  std::vector<std::int64_t> cell_indirect;  // [cell * bands + band]
  std::vector<std::int64_t> side_sky;  // the part of side_indirect that comes unscattered from the sky; empty without a sky
  std::vector<std::int64_t> cell_sky;  // the same part of cell_indirect
  std::vector<PlaneResult> planes;     // [plane of the model]
  std::vector<std::vector<SensorResult>> sensors;  // [sensor of the model][point]
  std::vector<SensorResult> sensor_means;          // [sensor of the model], over its points
  std::vector<double> w_per_quantum;               // [waveband], W per quantum of the arrays above
  Estimate sunlit_leaf_fraction;
  ShadeClassResult leaf_classes;   // of all leaves
  Estimate ground_sunfleck_ratio;  // value NaN without a beam
  double leaf_area_index = 0.0;
  double ground_per_ray_m2 = 0.0;  // level ground that one landing represents, from which irradiance follows
  std::uint64_t lost_rays = 0;
  PassSummary direct;
  IndirectSummary indirect;
  SensorSummary of_sensors;
  Work work;       // of each replicate
  Work next_work;  // suitable start for a run on a very similar scene with the same bounds

  // Return the irradiance (W m-2) of a side, or of a cell of the soil's map, by all light but the beam; 0 without area.
  [[nodiscard]] double side_indirect_w_m2(std::size_t side, double area_m2, std::size_t band) const {
    return indirect_w_m2(side_indirect, side, area_m2, band);
  }
  [[nodiscard]] double cell_indirect_w_m2(std::size_t cell, double area_m2, std::size_t band) const {
    return indirect_w_m2(cell_indirect, cell, area_m2, band);
  }

  // Return the part of that irradiance that comes unscattered from the sky.
  [[nodiscard]] double side_sky_w_m2(std::size_t side, double area_m2, std::size_t band) const {
    return indirect_w_m2(side_sky, side, area_m2, band);
  }
  [[nodiscard]] double cell_sky_w_m2(std::size_t cell, double area_m2, std::size_t band) const {
    return indirect_w_m2(cell_sky, cell, area_m2, band);
  }

  // Returns the irradiance (W m-2) that `landings` cause on `area_m2` in a band with that horizontal beam irradiance; 0
  // without area.
  [[nodiscard]] double irradiance_w_m2(std::uint64_t landings, double area_m2, double beam_w_m2) const {
    return area_m2 > 0.0 ? static_cast<double>(landings) * ground_per_ray_m2 * beam_w_m2 / area_m2 : 0.0;
  }

  // Returns the irradiance (W m-2) of a side by the beam, estimated if the light of triangles was; 0 without area.
  [[nodiscard]] double side_direct_w_m2(std::size_t side, double area_m2, double beam_w_m2) const {
    if (!side_direct.empty()) {
      const double landings = static_cast<double>(side_direct[side]) / static_cast<double>(parts_per_landing);
      return area_m2 > 0.0 ? landings * ground_per_ray_m2 * beam_w_m2 / area_m2 : 0.0;
    }
    return irradiance_w_m2(elements[side / 2].side(side % 2), area_m2, beam_w_m2);
  }

 private:
  [[nodiscard]] double indirect_w_m2(const std::vector<std::int64_t>& quanta, std::size_t place, double area_m2,
                                     std::size_t band) const {
    if (quanta.empty() || !(area_m2 > 0.0)) return 0.0;
    return static_cast<double>(quanta[place * w_per_quantum.size() + band]) * w_per_quantum[band] / area_m2;
  }
};

}  // namespace sunfleck

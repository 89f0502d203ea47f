#include "physics/transport/solve/result_of.h"

#include "base/error.h"
#include "base/units.h"
#include "physics/transport/solve/unseen_areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunfleck {
namespace {

// A half-width of a share from here on means that nothing is known except that the share lies between 0 and 1.
constexpr double unknown_share = 1.0 - 1e-9;

// Makes the result of one series of replicates.
class ResultMaker {
 public:
  ResultMaker(const RunSums& sums, double confidence)
      : sums_(sums),
        model_(sums.conversion.model),
        layout_(sums.conversion.layout),
        quanta_(sums.conversion.quanta),
        events_(sums.events(confidence)),
        areas_(sums.conversion.areas),
        confidence_(confidence),
        quantile_(t_quantile(confidence, sums.replicates)) {}

  [[nodiscard]] RadiationResult figures() const {
    RadiationResult result;
    for (std::size_t b = 0; b < model_.bands.size(); ++b) {
      result.bands.push_back(band_result(b));
      result.w_per_quantum.push_back(quanta_[b].w_m2_per_quantum * model_.plot.area_m2() /
                                     std::max(1.0, static_cast<double>(sums_.replicates)));
    }
    result.organs = organ_results();
    result.plants = plant_results();
    result.layers = layer_results();
    const double unseen_leaves_m2 = unseen_areas().of_leaves_m2();
    result.leaf_classes = sums_.classes.leaves(unseen_leaves_m2, class_errors());
    result.element_error = sums_.element_errors(quantile_);
    result.side_error = sums_.side_errors(quantile_);
    if (sums_.planes) {
      std::vector<double> events_w_m2, unshot_w_m2;
      for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
        events_w_m2.push_back(events_.largest_w_m2(b));
        unshot_w_m2.push_back(unshot_through_w_m2(b));
      }
      result.planes = sums_.planes->results(quantile_, unseen_events(confidence_), events_w_m2, unshot_w_m2);
    }
    result.sunlit_leaf_fraction = sunlit_estimate(sums_.sunlit, areas_.facing_m2, unseen_leaves_m2);
    result.ground_sunfleck_ratio = {no_value, no_value};
    if (model_.has_beam()) result.ground_sunfleck_ratio = sums_.ground_ratio.estimate(quantile_, unseen(share_of_one_ray()));
    result.leaf_area_index = areas_.foliage_m2 / model_.plot.area_m2();
    result.ground_per_ray_m2 =
        sums_.replicates > 0 ? sums_.conversion.ground_per_ray_m2 / static_cast<double>(sums_.replicates) : 0.0;
    result.lost_rays = sums_.lost;
    result.indirect.sky_rays = sums_.sky_rays;
    result.indirect.packets = sums_.packets;
    result.indirect.rounds = sums_.rounds;
    return result;
  }

 private:
  [[nodiscard]] double unseen(double event) const { return sums_.unseen(event, confidence_); }
  [[nodiscard]] UnseenAreas unseen_areas() const { return {sums_, unseen(1.0)}; }

  [[nodiscard]] ShadeClasses::Errors class_errors() const {
    ShadeClasses::Errors errors{
        quantile_, t_quantile(confidence_, SpreadMean::effective(sums_.replicates)), unseen(1.0), {}, {}, {}};
    for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
      errors.unshot_share.push_back(sums_.ledgers[b].unshot_share());
      errors.event_w.push_back(events_.largest_w_m2(b) * model_.plot.area_m2());
      errors.other_event_w.push_back(events_.other_w_m2(b) * model_.plot.area_m2());
    }
    return errors;
  }

  [[nodiscard]] BandResult band_result(std::size_t band) const {
    const FluxLedger& ledger = sums_.ledgers[band];
    if (ledger.residual() != 0) {
      throw_failure(fmt::format("band {}: the flux ledger misses {} quanta", model_.bands[band].name, ledger.residual()),
                    "incident must equal absorbed + reflected + transmitted + unshot",
                    "run it with --device cpu, and report the device and the scene");
    }
    const double per_quantum = quanta_[band].w_m2_per_quantum / std::max(1.0, static_cast<double>(sums_.replicates));
    BandResult result;
    result.name = model_.bands[band].name;
    result.ledger = ledger;
    result.incident.value = static_cast<double>(ledger.incident) * per_quantum;
    result.unshot = sums_.unshot_w_m2(band);
    const auto estimate = [&](std::int64_t quanta, const ReplicateMean& mean, double event_w_m2) {
      const Estimate of_mean = mean.estimate(quantile_, unseen(event_w_m2));
      return Estimate{static_cast<double>(quanta) * per_quantum, of_mean.half_width + result.unshot};
    };
    const double any = events_.largest_w_m2(band);
    const double on_ground = std::max(any, events_.around_w_m2[band]);
    // Where no ray met the ground of an isolated stand, the spread of what met the stand says nothing of it.
    const bool misses_ground = !model_.plot.periodic && model_.has_beam() && !(sums_.first_ground.mean() > 0.0);
    const double unseen_ground_w_m2 = misses_ground ? unseen(events_.around_w_m2[band]) : 0.0;
    if (!model_.plot.periodic && (model_.has_beam() || model_.has_sky())) {  // what lamps emit is exact
      result.incident.half_width = sums_.bands[band].incident.estimate(quantile_, unseen(on_ground)).half_width;
      result.incident.half_width = std::hypot(result.incident.half_width, unseen_ground_w_m2);
    }
    const double packet = scatters(model_, band) ? events_.other_w_m2(band) : 0.0;
    const double beam = areas_.beam_meets_canopy() ? events_.beam_w_m2[band] : 0.0;
    const double fallen = !model_.soil ? std::max(beam, events_.other_w_m2(band)) : !model_.plot.periodic ? packet : 0.0;
    result.absorbed_vegetation =
        estimate(ledger.absorbed_vegetation, sums_.bands[band].vegetation, any * areas_.vegetation_absorptance[band]);
    if (std::find(areas_.on_structures.begin(), areas_.on_structures.end(), true) != areas_.on_structures.end()) {
      result.absorbed_structure =
          estimate(ledger.absorbed_structure, sums_.bands[band].structure, any * areas_.structure_absorptance[band]);
    }
    result.absorbed_soil = estimate(ledger.absorbed_soil, sums_.bands[band].soil, on_ground * areas_.soil_absorptance[band]);
    result.reflected = estimate(ledger.reflected, sums_.bands[band].reflected, packet);
    if (model_.soil) {
      result.reflected.half_width =
          std::hypot(result.reflected.half_width, unseen_ground_w_m2 * model_.soil->reflectance[band]);
    }
    result.transmitted = estimate(ledger.transmitted, sums_.bands[band].transmitted, fallen);
    return result;
  }

  // Returns the share of `facing_m2` in direct sun. Its interval follows from the spread of `mean` and, where that says little
  // or nothing of it, from the unseen area. Both numbers are NaN if the beam can hit none of the area, or so little of it that
  // any share would agree with what the rays met.
  [[nodiscard]] Estimate sunlit_estimate(const ReplicateMean& mean, double facing_m2, double unseen_lit_m2) const {
    if (!(facing_m2 > 0.0)) return {no_value, no_value};
    const double unseen_share = unseen_lit_m2 / facing_m2;
    if (mean.says_little() && unseen_share >= unknown_share) return {no_value, no_value};
    return mean.estimate_of_area(quantile_, unseen_share, 1.0);
  }

  // Returns how much one beam ray changes a share of the rays that meet the scene, in one replicate.
  [[nodiscard]] double share_of_one_ray() const {
    return areas_.beam_meets_canopy() && sums_.met.mean() > 0.0 ? events_.beam_share / sums_.met.mean() : 0.0;
  }

  [[nodiscard]] std::vector<OrganResult> organ_results() const {
    const std::vector<double> unseen_lit_m2 = unseen_areas().of_organs_m2();
    const ShadeClasses::Errors errors = class_errors();
    std::vector<OrganResult> results;
    for (std::size_t o = 0; o < sums_.organs.size(); ++o) {
      OrganResult result;
      result.area_m2 = areas_.organ_m2[o];
      result.sunlit_fraction = sunlit_estimate(sums_.organs[o].sunlit, areas_.organ_facing_m2[o], unseen_lit_m2[o]);
      const double per_area = areas_.organ_m2[o] > 0.0 ? model_.plot.area_m2() / areas_.organ_m2[o] : 0.0;
      for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
        const double absorptance = areas_.organ_absorptance[o * sums_.bands.size() + b];
        const double beam = areas_.organ_facing_m2[o] > 0.0 ? events_.beam_w_m2[b] : 0.0;
        const double other = absorptance > 0.0 ? events_.other_w_m2(b) : 0.0;
        result.direct.push_back(sums_.organs[o].direct[b].estimate(quantile_, unseen(beam * per_area)));
        const double scattered_share = sums_.unshot_share_of_scattered(b);
        result.indirect.push_back(with_unshot_share(sums_.organs[o].indirect[b], other * per_area, scattered_share));
        result.absorbed.push_back(of_both(sums_.organs[o].absorbed[b], varies_on_organ(o, b), beam * absorptance * per_area,
                                          other * absorptance * per_area, b));
      }
      result.classes = sums_.classes.organ(o, unseen_lit_m2[o], errors);
      results.push_back(std::move(result));
    }
    return results;
  }

  // Whether the replicates differ in the light that the beam brings, and in all other light.
  struct Varies {
    bool beam = false, other = false;
  };
  [[nodiscard]] Varies varies_on_organ(std::size_t organ, std::size_t band) const {
    const OrganMeans& means = sums_.organs[organ];
    return {means.direct[band].squares() > 0.0, means.indirect[band].squares() > 0.0};
  }
  // [plant * bands + band]
  [[nodiscard]] std::vector<Varies> varies_on_plants() const {
    const std::size_t bands = sums_.bands.size();
    std::vector<Varies> result(areas_.plants.size() * bands);
    for (std::size_t s = 0; s < sums_.conversion.surfaces.of.size(); ++s) {
      const std::uint32_t plant = areas_.plants.of_surface[s];
      if (plant == PlantAreas::no_plant) continue;
      for (std::size_t b = 0; b < bands; ++b) {
        const Varies organ = varies_on_organ(sums_.conversion.surfaces.of[s].organ, b);
        Varies& varies = result[plant * bands + b];
        varies = {varies.beam || organ.beam, varies.other || organ.other};
      }
    }
    return result;
  }

  // Returns a mean of the beam's light and other light together. One event of the beam changes it by `beam`, one of other light by
  // `other`. Where one part never varied, perhaps because it never came, the spread of the other says nothing of it.
  [[nodiscard]] Estimate of_both(const ReplicateMean& mean, Varies varies, double beam, double other, std::size_t band) const {
    Estimate both = with_unshot(mean, std::max(beam, other), band);
    if (!(mean.squares() > 0.0)) return both;
    if (!varies.beam) both.half_width = std::hypot(both.half_width, unseen(beam));
    if (!varies.other) both.half_width = std::hypot(both.half_width, unseen(other));
    return both;
  }

  [[nodiscard]] std::vector<PlantResult> plant_results() const {
    const PlantAreas& plants = areas_.plants;
    const std::vector<double> unseen_lit_m2 = unseen_areas().of_plants_m2();
    const std::vector<Varies> varies = varies_on_plants();
    std::vector<PlantResult> results;
    for (std::size_t p = 0; p < plants.size(); ++p) {
      PlantResult result;
      result.plant = plants.sites[p].plant;
      result.position_m = plants.sites[p].position_m;
      result.height_m = plants.height_m[p];
      result.leaf_area_m2 = plants.leaf_m2[p];
      result.sunlit_leaf_fraction = sunlit_estimate(sums_.plants[p].sunlit, plants.facing_leaf_m2[p], unseen_lit_m2[p]);
      for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
        const std::size_t place = p * sums_.bands.size() + b;
        const double absorptance = plants.largest_absorptance[place];
        const double beam_w = plants.beam_meets[p] ? events_.beam_w_m2[b] * model_.plot.area_m2() : 0.0;
        const double other_w = events_.other_w_m2(b) * model_.plot.area_m2();
        result.incident_w.push_back(of_both(sums_.plants[p].incident[b], varies[place], beam_w, other_w, b));
        result.absorbed_w.push_back(
            of_both(sums_.plants[p].absorbed[b], varies[place], beam_w * absorptance, other_w * absorptance, b));
      }
      results.push_back(std::move(result));
    }
    return results;
  }

  // Returns the mean with its interval, which includes unshot flux in proportion; one event changes it by `event_w_m2`.
  [[nodiscard]] Estimate with_unshot(const ReplicateMean& mean, double event_w_m2, std::size_t band) const {
    return with_unshot_share(mean, event_w_m2, sums_.ledgers[band].unshot_share());
  }
  [[nodiscard]] Estimate with_unshot_share(const ReplicateMean& mean, double event_w_m2, double share) const {
    Estimate estimate = mean.estimate(quantile_, unseen(event_w_m2));
    estimate.half_width += estimate.value * share;
    return estimate;
  }

  // Returns the most that unshot flux would still bring through a plane in one direction, W m-2. It crosses the plane on every
  // second flight at most, and makes a flight more than it has landings.
  [[nodiscard]] double unshot_through_w_m2(std::size_t band) const {
    const double waited = sums_.first_waiting[band];
    const double landings = waited > 0.0 ? (sums_.landed[band] - sums_.sky_landed[band]) / waited : 0.0;
    return 0.5 * (2.0 + landings) * sums_.unshot_w_m2(band);
  }

  [[nodiscard]] std::vector<LayerResult> layer_results() const {
    const std::size_t count = areas_.layer_foliage_m2.size();
    const std::vector<double> unseen_lit_m2 = unseen_areas().of_layers_m2();
    const ShadeClasses::Errors errors = class_errors();
    const double one_ray = unseen(share_of_one_ray());
    std::vector<LayerResult> results;
    for (std::size_t k = 0; k <= count; ++k) {
      const LayerMeans& means = sums_.layers[k];
      LayerResult result;
      result.height_m = layout_.layers.height_m * static_cast<double>(k) / static_cast<double>(count);
      const bool below_top = k < count;
      result.sunfleck_ratio = {no_value, no_value};
      if (model_.has_beam()) result.sunfleck_ratio = means.ratio.estimate(quantile_, below_top ? one_ray : 0.0);
      result.sunlit_leaf_fraction = {no_value, no_value};
      if (below_top) {
        result.leaf_area_index = areas_.layer_foliage_m2[k] / model_.plot.area_m2();
        result.leaf_classes = sums_.classes.layer(k, unseen_lit_m2[k], errors);
        result.sunlit_leaf_fraction = sunlit_estimate(means.sunlit, areas_.layer_facing_m2[k], unseen_lit_m2[k]);
      }
      for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
        const double any = std::max(areas_.beam_meets_canopy() ? events_.beam_w_m2[b] : 0.0, events_.other_w_m2(b));
        const double packet = scatters(model_, b) ? events_.other_w_m2(b) : 0.0;
        result.down.push_back(means.down[b].estimate(quantile_, unseen(below_top ? any : 0.0)));
        result.up.push_back(means.up[b].estimate(quantile_, unseen(packet)));
        if (below_top) result.down.back().half_width += unshot_through_w_m2(b);
        result.up.back().half_width += below_top ? unshot_through_w_m2(b) : sums_.unshot_w_m2(b);
        if (!below_top) continue;
        const double by_plants = areas_.layer_holds_vegetation[k] ? any * areas_.vegetation_absorptance[b] : 0.0;
        const double by_structures = areas_.layer_holds_structure[k] ? any * areas_.structure_absorptance[b] : 0.0;
        result.absorbed.push_back(with_unshot(means.absorbed[b], by_plants, b));
        result.absorbed_structure.push_back(with_unshot(means.absorbed_structure[b], by_structures, b));
      }
      results.push_back(std::move(result));
    }
    return results;
  }

  const RunSums& sums_;
  const RadiationModel& model_;
  const CounterLayout& layout_;
  const std::vector<BandQuanta>& quanta_;
  LightEvents events_;
  const CanopyAreas& areas_;
  double confidence_, quantile_;
};

}  // namespace

RadiationResult figures_of(const RunSums& sums, double confidence) {
  return ResultMaker(sums, confidence).figures();
}

void copy_arrays(const RunSums& sums, RadiationResult& result) {
  result.elements = sums.elements;
  result.soil_cells = sums.soil_cells;
  result.side_indirect = sums.side_landed.all();
  result.cell_indirect = sums.cell_landed.all();
  result.side_sky = sums.side_sky.all();
  result.cell_sky = sums.cell_sky.all();
}

void move_arrays(RunSums& sums, RadiationResult& result) {
  result.elements = std::move(sums.elements);
  result.soil_cells = std::move(sums.soil_cells);
  result.side_indirect = sums.side_landed.take_all();
  result.cell_indirect = sums.cell_landed.take_all();
  result.side_sky = sums.side_sky.take_all();
  result.cell_sky = sums.cell_sky.take_all();
}

RadiationResult result_of(const RunSums& sums, double confidence) {
  RadiationResult result = figures_of(sums, confidence);
  copy_arrays(sums, result);
  return result;
}

}  // namespace sunfleck

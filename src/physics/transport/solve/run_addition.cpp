#include "physics/transport/solve/run_addition.h"

#include "base/error.h"

#include <fmt/format.h>

#include <span>
#include <vector>

namespace sunfleck {
namespace {

// Largest value that the integer sums of all landings together may reach.
constexpr double most_landed = 0x1p62;

// Returns the quanta that landed, counted once per landing. [band]
std::vector<double> landed_quanta(const IndirectSums& indirect) {
  std::vector<double> landed(indirect.bands);
  const auto add = [&](std::size_t, std::span<const std::int64_t> quanta) {
    for (std::size_t b = 0; b < landed.size(); ++b) landed[b] += static_cast<double>(quanta[b]);
  };
  for (std::size_t k = 0; k < indirect.surface_landed.size(); k += indirect.bands) {
    add(k, std::span(indirect.surface_landed).subspan(k, indirect.bands));
  }
  indirect.cell_landed.for_each(add);
  return landed;
}

// Adds each value to its sum; `sums` is empty before the first replicate.
template <class Values, class Sum>
void add_up(const Values& values, std::vector<Sum>& sums) {
  sums.resize(values.size());
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += values[k];
}

// Adds one replicate to the sums.
class Addition {
 public:
  Addition(RunSums& sums, const Replicate& replicate)
      : sums_(sums),
        replicate_(replicate),
        direct_(replicate.direct),
        indirect_(replicate.packets ? &*replicate.packets : nullptr),
        conversion_(sums.conversion),
        model_(conversion_.model),
        surfaces_(conversion_.surfaces),
        areas_(conversion_.areas),
        quanta_(conversion_.quanta),
        share_(conversion_.ground_per_ray_m2 / model_.plot.area_m2()) {}

  void add() {
    ++sums_.replicates;
    sums_.lost += direct_.lost;
    if (indirect_ != nullptr) {
      count_landed();
      sums_.lost += indirect_->lost;
      sums_.sky_rays += indirect_->sky_rays;
      sums_.packets += indirect_->packets;
      sums_.rounds += indirect_->rounds;
    }
    add_to_ledgers();
    add_to_band_means();
    add_to_organ_means();
    add_to_plant_means();
    add_to_layer_means();
    sums_.classes.add(replicate_, sums_.side_landed);  // also adds what landed to side_landed
    if (sums_.planes) add_to_planes();
    add_arrays();
    add_landings();
    add_spreads();
  }

 private:
  void count_landed() {
    const std::vector<double> landed = landed_quanta(*indirect_);
    for (std::size_t b = 0; b < sums_.landed.size(); ++b) {
      sums_.landed[b] += landed[b];
      sums_.sky_landed[b] += static_cast<double>(indirect_->sky_landed[b]);
      sums_.first_waiting[b] += static_cast<double>(indirect_->first_waiting[b]);
      if (sums_.landed[b] <= most_landed) continue;
      throw_failure(fmt::format("band {}: its light landed too often for the integer sums of {} replicates",
                                model_.bands[b].name, sums_.replicates),
                    fmt::format("{:.3g} quanta, at most {:.3g} are possible", sums_.landed[b], most_landed),
                    "lower reflectance + transmittance where surfaces enclose the light, or give fewer --passes");
    }
  }

  void add_to_planes() {
    std::vector<double> per_ray, per_quantum;
    for (std::size_t b = 0; b < quanta_.size(); ++b) {
      per_ray.push_back(share_ * conversion_.beam_w_m2(b));
      per_quantum.push_back(quanta_[b].w_m2_per_quantum);
    }
    sums_.planes->add(model_.has_beam() ? &replicate_.passed : nullptr, indirect_ != nullptr ? &indirect_->receivers : nullptr,
                      per_ray, per_quantum);
  }

  void add_to_ledgers() {
    const std::vector<std::int64_t> waiting = conversion_.scattered(direct_);
    for (std::size_t b = 0; b < sums_.ledgers.size(); ++b) {
      FluxLedger& ledger = sums_.ledgers[b];
      const std::int64_t per_ray = quanta_[b].per_ray;
      ledger.incident +=
          static_cast<std::int64_t>(model_.plot.periodic ? conversion_.rays : direct_.met + direct_.lost) * per_ray;
      for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
        const Surface& surface = surfaces_.of[s];
        ledger.absorbed_by(surface.role) +=
            static_cast<std::int64_t>(direct_.surface[s].upper) * conversion_.split(surface.optics, 0, b).absorbed +
            static_cast<std::int64_t>(direct_.surface[s].lower) * conversion_.split(surface.optics, 1, b).absorbed;
      }
      if (model_.soil) {
        ledger.absorbed_soil += static_cast<std::int64_t>(direct_.soil_plane) * conversion_.soil_split(b).absorbed;
      }
      ledger.transmitted += static_cast<std::int64_t>(direct_.transmitted) * per_ray;
      ledger.unshot += static_cast<std::int64_t>(direct_.lost) * per_ray;
      if (indirect_ == nullptr) {
        for (std::size_t k = b; k < waiting.size(); k += sums_.ledgers.size()) ledger.unshot += waiting[k];
        const std::int64_t other = quanta_[b].lamps + (model_.plot.periodic ? quanta_[b].sky : 0);
        ledger.incident += other;
        ledger.unshot += other;
        continue;
      }
      const FluxLedger& packets = indirect_->ledger[b];
      ledger.incident += packets.incident;
      ledger.absorbed_vegetation += packets.absorbed_vegetation;
      ledger.absorbed_structure += packets.absorbed_structure;
      ledger.absorbed_soil += packets.absorbed_soil;
      ledger.reflected += packets.reflected;
      ledger.transmitted += packets.transmitted;
      ledger.unshot += packets.unshot;
    }
  }

  void add_to_band_means() {
    std::uint64_t vegetation = 0;
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      if (is_vegetation(surfaces_.of[s].role)) vegetation += direct_.surface[s].both();
    }
    sums_.first_vegetation.add(static_cast<double>(vegetation) * share_);
    sums_.first_ground.add(static_cast<double>(direct_.ground) * share_);
    sums_.met.add(static_cast<double>(direct_.met) * share_);
    sums_.ground_ratio.add(direct_.met > 0 ? static_cast<double>(direct_.ground) / static_cast<double>(direct_.met) : 0.0);
    for (std::size_t b = 0; b < sums_.bands.size(); ++b) {
      double first_vegetation = 0.0;
      double first_structure = 0.0;
      double first_soil = model_.soil ? (1.0 - model_.soil->reflectance[b]) * static_cast<double>(direct_.soil_plane) : 0.0;
      for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
        const Surface& surface = surfaces_.of[s];
        (surface.soil()                ? first_soil
         : is_vegetation(surface.role) ? first_vegetation
                                       : first_structure) +=
            static_cast<double>(direct_.surface[s].upper) * conversion_.absorptance(surface.optics, 0, b) +
            static_cast<double>(direct_.surface[s].lower) * conversion_.absorptance(surface.optics, 1, b);
      }
      const FluxLedger packets = indirect_ != nullptr ? indirect_->ledger[b] : FluxLedger{};
      const double per_quantum = quanta_[b].w_m2_per_quantum;
      const double indirect_vegetation = static_cast<double>(packets.absorbed_vegetation) * per_quantum;
      const double indirect_soil = static_cast<double>(packets.absorbed_soil) * per_quantum;
      const double direct = share_ * conversion_.beam_w_m2(b);
      const double incident =
          static_cast<double>(direct_.met + direct_.lost) * direct + static_cast<double>(packets.incident) * per_quantum;
      sums_.bands[b].incident.add(model_.plot.periodic ? 0.0 : incident);
      sums_.bands[b].vegetation.add(first_vegetation * direct + indirect_vegetation);
      sums_.bands[b].structure.add(first_structure * direct + static_cast<double>(packets.absorbed_structure) * per_quantum);
      sums_.bands[b].soil.add(first_soil * direct + indirect_soil);
      sums_.bands[b].indirect_vegetation.add(indirect_vegetation);
      sums_.bands[b].indirect_soil.add(indirect_soil);
      sums_.bands[b].reflected.add(static_cast<double>(packets.reflected) * per_quantum);
      sums_.bands[b].transmitted.add(static_cast<double>(direct_.transmitted) * direct +
                                     static_cast<double>(packets.transmitted) * per_quantum);
    }
  }

  void add_to_organ_means() {
    const std::size_t bands = sums_.bands.size();
    const std::size_t organs = sums_.organs.size();
    std::vector<double> landed(organs);
    std::vector<double> direct_absorbed(organs * bands), indirect_landed(organs * bands), indirect_absorbed(organs * bands);
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      const Surface& surface = surfaces_.of[s];
      const BeamLandings& landings = direct_.surface[s];
      landed[surface.organ] += static_cast<double>(landings.both());
      for (std::size_t b = 0; b < bands; ++b) {
        const std::size_t place = surface.organ * bands + b;
        for (std::size_t side = 0; side < 2; ++side) {
          direct_absorbed[place] += static_cast<double>(landings.side(side)) * conversion_.absorptance(surface.optics, side, b);
          if (indirect_ == nullptr) continue;
          const auto quanta = static_cast<double>(indirect_->surface_landed[(s * 2 + side) * bands + b]);
          indirect_landed[place] += quanta;
          indirect_absorbed[place] += quanta * conversion_.absorptance(surface.optics, side, b);
        }
      }
    }
    for (std::size_t o = 0; o < organs; ++o) {
      const double per_area = areas_.organ_m2[o] > 0.0 ? 1.0 / areas_.organ_m2[o] : 0.0;
      sums_.organs[o].landed.add(landed[o] * conversion_.ground_per_ray_m2 * per_area);
      sums_.organs[o].sunlit.add(direct_.organ_lit_m2[o] *
                                 (areas_.organ_facing_m2[o] > 0.0 ? 1.0 / areas_.organ_facing_m2[o] : 0.0));
      for (std::size_t b = 0; b < bands; ++b) {
        const double direct = conversion_.ground_per_ray_m2 * conversion_.beam_w_m2(b) * per_area;
        const double per_quantum = quanta_[b].w_m2_per_quantum * model_.plot.area_m2() * per_area;
        const std::size_t place = o * bands + b;
        sums_.organs[o].direct[b].add(landed[o] * direct);
        sums_.organs[o].indirect[b].add(indirect_landed[place] * per_quantum);
        sums_.organs[o].absorbed[b].add(direct_absorbed[place] * direct + indirect_absorbed[place] * per_quantum);
        sums_.organs[o].indirect_absorbed[b].add(indirect_absorbed[place] * per_quantum);
      }
    }
  }

  void add_to_plant_means() {
    const PlantAreas& plants = areas_.plants;
    const std::size_t bands = sums_.bands.size();
    std::vector<double> incident_w(plants.size() * bands), absorbed_w(plants.size() * bands);
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      if (plants.of_surface[s] == PlantAreas::no_plant) continue;
      const BeamLandings& landings = direct_.surface[s];
      for (std::size_t b = 0; b < bands; ++b) {
        const std::size_t place = plants.of_surface[s] * bands + b;
        const double w_per_quantum = quanta_[b].w_m2_per_quantum * model_.plot.area_m2();
        for (std::size_t side = 0; side < 2; ++side) {
          double flux_w = static_cast<double>(landings.side(side)) * conversion_.ground_per_ray_m2 * conversion_.beam_w_m2(b);
          if (indirect_ != nullptr) {
            flux_w += static_cast<double>(indirect_->surface_landed[(s * 2 + side) * bands + b]) * w_per_quantum;
          }
          incident_w[place] += flux_w;
          absorbed_w[place] += flux_w * conversion_.absorptance(surfaces_.of[s].optics, side, b);
        }
      }
    }
    for (std::size_t p = 0; p < plants.size(); ++p) {
      sums_.plants[p].sunlit.add(plants.facing_leaf_m2[p] > 0.0 ? direct_.plant_lit_m2[p] / plants.facing_leaf_m2[p] : 0.0);
      for (std::size_t b = 0; b < bands; ++b) {
        sums_.plants[p].incident[b].add(incident_w[p * bands + b]);
        sums_.plants[p].absorbed[b].add(absorbed_w[p * bands + b]);
      }
    }
  }

  void add_to_layer_means() {
    const std::size_t optics_count = model_.optics.size();
    const std::size_t bands = sums_.bands.size();
    const std::size_t count = areas_.layer_foliage_m2.size();
    std::uint64_t below = direct_.ground;
    double lit_m2 = 0.0;
    for (std::size_t k = 0; k <= count; ++k) {
      LayerMeans& layer = sums_.layers[k];
      layer.ratio.add(direct_.met > 0 ? static_cast<double>(below) / static_cast<double>(direct_.met) : 0.0);
      for (std::size_t b = 0; b < bands; ++b) {
        const double per_quantum = quanta_[b].w_m2_per_quantum;
        const auto passed = [&](const std::vector<std::int64_t>& planes) {
          return static_cast<double>(planes[k * bands + b]) * per_quantum;
        };
        layer.down[b].add(static_cast<double>(below) * share_ * conversion_.beam_w_m2(b) +
                          (indirect_ != nullptr ? passed(indirect_->down) : 0.0));
        layer.up[b].add(indirect_ != nullptr ? passed(indirect_->up) : 0.0);
        if (k == count) continue;
        double absorbed = 0.0;
        double absorbed_structure = 0.0;
        for (std::size_t o = 0; o < optics_count; ++o) {
          const BeamLandings& landings = direct_.layer_optics[k * optics_count + o];
          for (std::size_t side = 0; side < 2; ++side) {
            double flux = static_cast<double>(landings.side(side)) * share_ * conversion_.beam_w_m2(b);
            if (indirect_ != nullptr) {
              flux +=
                  static_cast<double>(indirect_->layer_landed[((k * optics_count + o) * 2 + side) * bands + b]) * per_quantum;
            }
            (areas_.on_structures[o] ? absorbed_structure : absorbed) += flux * conversion_.absorptance(o, side, b);
          }
        }
        layer.absorbed[b].add(absorbed);
        layer.absorbed_structure[b].add(absorbed_structure);
      }
      if (k == count) break;
      lit_m2 += direct_.layer_lit_m2[k];
      layer.sunlit.add(areas_.layer_facing_m2[k] > 0.0 ? direct_.layer_lit_m2[k] / areas_.layer_facing_m2[k] : 0.0);
      for (std::size_t o = 0; o < optics_count; ++o) below += direct_.layer_optics[k * optics_count + o].both();
    }
    sums_.sunlit.add(areas_.facing_m2 > 0.0 ? lit_m2 / areas_.facing_m2 : 0.0);
  }

  void add_arrays() {
    add_up(std::span(replicate_.counters).subspan(shared::counter_first_cell, sums_.soil_cells.size()), sums_.soil_cells);
    if (indirect_ == nullptr) return;
    sums_.cell_landed.add(indirect_->cell_landed);
    sums_.side_sky.add(indirect_->side_sky);
    if (in_half()) {
      sums_.half_side_landed.add(indirect_->side_landed);
      sums_.half_side_sky.add(indirect_->side_sky);
    }
    sums_.cell_sky.add(indirect_->cell_sky);
  }

  // Returns whether this is one of every other replicate, the first included.
  [[nodiscard]] bool in_half() const { return sums_.keeps_half && sums_.replicates % 2 == 1; }

  void add_landings() {
    for (const std::uint32_t e : direct_.hit) {
      const BeamLandings landings = conversion_.element_landings(replicate_.counters, e);
      sums_.elements[e] += landings;
      if (in_half()) sums_.half_elements[e] += landings;
    }
  }

  void add_spreads() {
    if (sums_.direct_spread.empty()) return;
    const std::size_t bands = sums_.bands.size();
    std::vector<std::int64_t> side_landed;
    if (indirect_ != nullptr) side_landed = indirect_->side_landed.all();
    for (std::size_t e = 0; e < sums_.direct_spread.size(); ++e) {
      const BeamLandings landings = conversion_.element_landings(replicate_.counters, e);
      sums_.direct_spread[e].add(static_cast<double>(landings.both()));
      sums_.element_hits[e] += landings.both() + (indirect_ != nullptr ? indirect_->element_hits[e] : 0);
      const double per_area = conversion_.areas.per_m2[e];
      for (std::size_t b = 0; b < bands; ++b) {
        double absorbed = 0.0;
        double landed = 0.0;
        for (std::size_t side = 0; side < 2; ++side) {
          double other = 0.0;
          if (indirect_ != nullptr) {
            other = static_cast<double>(side_landed[(2 * e + side) * bands + b]) * quanta_[b].w_m2_per_quantum *
                    model_.plot.area_m2() * per_area;
          }
          landed += other;
          const double incident =
              static_cast<double>(landings.side(side)) * conversion_.ground_per_ray_m2 * conversion_.beam_w_m2(b) * per_area +
              other;
          absorbed += incident * conversion_.absorptance(model_.canopy.optics_of[e], side, b);
          if (!sums_.side_spread.empty()) sums_.side_spread[(2 * e + side) * bands + b].add(incident);
        }
        sums_.absorbed_spread[b * sums_.elements.size() + e].add(absorbed);
        if (!sums_.indirect_spread.empty()) sums_.indirect_spread[b * sums_.elements.size() + e].add(landed);
      }
    }
  }

  RunSums& sums_;
  const Replicate& replicate_;
  const DirectSums& direct_;
  const IndirectSums* indirect_;  // null without an indirect pass
  const Conversion& conversion_;
  const RadiationModel& model_;
  const Surfaces& surfaces_;
  const CanopyAreas& areas_;
  const std::vector<BandQuanta>& quanta_;
  double share_;  // of the plot, that one beam ray represents
};

}  // namespace

void add_replicate(const Replicate& replicate, RunSums& sums) {
  Addition(sums, replicate).add();
}

}  // namespace sunfleck

#include "transport/tally.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Largest value that the integer sums of all landings together may reach.
constexpr double most_landed = 0x1p62;

// Returns the quanta that landed in a band, counted once per landing.
double landed_quanta(const IndirectSums& indirect, std::size_t band) {
  double landed = 0.0;
  for (const auto* sums : {&indirect.surface_landed, &indirect.cell_landed}) {
    for (std::size_t k = band; k < sums->size(); k += indirect.bands) landed += static_cast<double>((*sums)[k]);
  }
  return landed;
}

}  // namespace

Tally::Tally(const RadiationModel& model, const CounterLayout& layout, const Surfaces& surfaces,
             const PlaneReceivers* receivers, const Incidence& incidence, ElementErrors element_errors)
    : model_(model),
      layout_(layout),
      surfaces_(surfaces),
      rays_(incidence.rays),
      ground_per_ray_m2_(incidence.ground_per_ray_m2),
      quanta_(make_band_quanta(model, incidence)),
      events_(make_light_events(model, quanta_, incidence)),
      exposure_(model, layout, incidence.ground_per_ray_m2),
      ledgers_(model.bands.size()),
      landed_(model.bands.size()),
      bands_(model.bands.size()),
      elements_(model.canopy.size()),
      soil_cells_(layout.cells()),
      element_errors_(element_errors) {
  measure_elements();
  split_rays();
  if (receivers != nullptr) planes_.emplace(*receivers, model);
  const std::size_t bands = model.bands.size();
  OrganMeans organ;
  for (auto* means : {&organ.direct, &organ.indirect, &organ.absorbed, &organ.indirect_absorbed}) means->resize(bands);
  organs_.assign(model.canopy.organs.size(), organ);
  LayerMeans layer;
  for (auto* means : {&layer.down, &layer.up, &layer.absorbed}) means->resize(bands);
  layers_.assign(static_cast<std::size_t>(layout.layers.count) + 1, layer);
  if (element_errors == ElementErrors::skip) return;
  direct_spread_.resize(model.canopy.size());
  element_hits_.resize(model.canopy.size());
  absorbed_spread_.resize(model.canopy.size() * bands);
  if (scatters(model) || model.has_sky()) indirect_spread_.resize(model.canopy.size() * bands);
  if (element_errors == ElementErrors::keep_sides) side_spread_.resize(2 * model.canopy.size() * bands);
}

// Sums the areas by organ and layer, in total and for elements that the beam can hit, and finds the largest absorptances.
void Tally::measure_elements() {
  const Canopy& canopy = model_.canopy;
  const std::size_t bands = quanta_.size();
  foliage_ = element_roles(canopy).foliage;
  const std::vector<bool> hidden = hidden_elements(model_, layout_);
  const std::vector<double> absorptances = largest_absorptances(model_);
  organ_area_m2_.assign(canopy.organs.size(), 0.0);
  organ_facing_m2_ = organ_area_m2_;
  organ_absorptance_.assign(canopy.organs.size() * bands, 0.0);
  vegetation_absorptance_.assign(bands, 0.0);
  soil_absorptance_ = soil_absorptances(model_);
  layer_foliage_m2_.assign(static_cast<std::size_t>(layout_.layers.count), 0.0);
  layer_facing_m2_ = layer_foliage_m2_;
  layer_holds_vegetation_.assign(layer_foliage_m2_.size(), false);
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const double area = area_m2(canopy.corners[e]);
    const std::size_t organ = canopy.organ_of[e];
    organ_area_m2_[organ] += area;
    if (exposure_.can_hit(e)) organ_facing_m2_[organ] += area;
    const bool soil = surfaces_.of[surfaces_.number_of[e]].soil;
    beam_meets_vegetation_ = beam_meets_vegetation_ || (!soil && exposure_.can_hit(e));
    for (std::size_t b = 0; b < bands && !hidden[e] && area > 0.0; ++b) {
      const double absorptance = absorptances[canopy.optics_of[e] * bands + b];
      for (double* largest :
           {&organ_absorptance_[organ * bands + b], &(soil ? soil_absorptance_ : vegetation_absorptance_)[b]}) {
        *largest = std::max(*largest, absorptance);
      }
    }
    if (!soil && !hidden[e] && area > 0.0) {
      const std::size_t first = first_layer(layout_, canopy.corners[e]);
      const std::size_t end = first + layout_.first_bin[e + 1] - layout_.first_bin[e];
      for (std::size_t k = first; k < end; ++k) layer_holds_vegetation_[k] = true;
    }
    if (!foliage_[e]) continue;
    foliage_m2_ += area;
    add_area_by_layer(layout_.layers, canopy.corners[e], layer_foliage_m2_);
    if (!exposure_.can_hit(e)) continue;
    facing_m2_ += area;
    add_area_by_layer(layout_.layers, canopy.corners[e], layer_facing_m2_);
  }
}

// Computes how a ray's quanta split on each face. The rounding is the same for every ray; it is one quantum in some ten
// million.
void Tally::split_rays() {
  constexpr double middle = 0.5;
  for (const SurfaceOptics& optics : model_.optics) {
    for (const auto* face : {&optics.upper, &optics.lower}) {
      for (std::size_t b = 0; b < quanta_.size(); ++b) {
        splits_.push_back(split_quanta(quanta_[b].per_ray, (*face)[b].reflectance, (*face)[b].transmittance, middle));
      }
    }
  }
  if (!model_.soil) return;
  for (std::size_t b = 0; b < quanta_.size(); ++b) {
    splits_.push_back(split_quanta(quanta_[b].per_ray, model_.soil->reflectance[b], 0.0, middle));
  }
}

const QuantaSplit& Tally::split_of(std::size_t optics, std::size_t side, std::size_t band) const {
  return splits_[(optics * 2 + side) * quanta_.size() + band];
}

double Tally::absorptance(std::size_t optics, std::size_t side, std::size_t band) const {
  const SurfaceOptics& surface = model_.optics[optics];
  return (side == 0 ? surface.upper : surface.lower)[band].absorptance();
}

double Tally::beam_w_m2(std::size_t band) const {
  return model_.has_beam() ? model_.bands[band].direct_w_m2 : 0.0;
}

Tally::Landings Tally::element_landings(std::span<const std::uint32_t> counters, std::size_t element) const {
  Landings landings;
  for (std::uint32_t bin = layout_.first_bin[element]; bin < layout_.first_bin[element + 1]; ++bin) {
    landings.upper += counters[layout_.first_bin_word + 2 * bin];
    landings.lower += counters[layout_.first_bin_word + 2 * bin + 1];
  }
  return landings;
}

DirectSums Tally::sum(std::span<const std::uint32_t> counters) const {
  DirectSums sums;
  sums.surface.resize(surfaces_.of.size());
  sums.layer_optics.resize(layer_foliage_m2_.size() * model_.optics.size());
  sums.organ_lit_m2.resize(organ_area_m2_.size());
  sums.layer_lit_m2.resize(layer_foliage_m2_.size());
  sums.transmitted = counters[shared::counter_transmitted];
  sums.missed = counters[shared::counter_missed];
  sums.lost = counters[shared::counter_lost];
  for (std::uint32_t cell = 0; cell < layout_.cells(); ++cell) sums.soil_plane += counters[shared::counter_first_cell + cell];
  sum_elements(counters, sums);
  sums.met = model_.plot.periodic ? rays_ : counters[shared::counter_met];
  sums.ground = sums.soil_plane + sums.transmitted;
  for (std::size_t s = 0; s < surfaces_.of.size(); ++s) sums.ground += surfaces_.of[s].soil ? sums.surface[s].both() : 0;
  check(sums);
  return sums;
}

void Tally::sum_elements(std::span<const std::uint32_t> counters, DirectSums& sums) const {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Landings element = element_landings(counters, e);
    if (element.both() == 0) continue;
    const std::uint32_t number = surfaces_.number_of[e];
    const Surface& surface = surfaces_.of[number];
    sums.surface[number].upper += element.upper;
    sums.surface[number].lower += element.lower;
    sums.organ_lit_m2[surface.organ] += static_cast<double>(element.both()) * double{exposure_.lit_m2_per_landing(e)};
    if (surface.soil) continue;
    std::size_t layer = first_layer(layout_, model_.canopy.corners[e]);
    for (std::uint32_t bin = layout_.first_bin[e]; bin < layout_.first_bin[e + 1]; ++bin, ++layer) {
      const std::uint32_t upper = counters[layout_.first_bin_word + 2 * bin];
      const std::uint32_t lower = counters[layout_.first_bin_word + 2 * bin + 1];
      Landings& in_layer = sums.layer_optics[layer * model_.optics.size() + surface.optics];
      in_layer.upper += upper;
      in_layer.lower += lower;
      if (foliage_[e]) sums.layer_lit_m2[layer] += (1.0 * upper + lower) * double{exposure_.lit_m2_per_landing(e)};
    }
  }
}

void Tally::check(const DirectSums& sums) const {
  std::uint64_t landed = sums.soil_plane + sums.transmitted + sums.lost;
  for (const Landings& surface : sums.surface) landed += surface.both();
  const std::uint64_t sent = model_.plot.periodic ? rays_ : sums.met + sums.lost;
  const std::uint64_t followed = model_.plot.periodic ? rays_ : sent + sums.missed;
  if (landed == sent && followed == rays_) return;
  throw_failure(fmt::format("direct pass: {} of {} rays landed, {} were followed", landed, sent, followed),
                "every ray sent must land, leave or be counted as lost",
                "run it with --device cpu, and report the device and the scene");
}

std::vector<std::int64_t> Tally::scattered(const DirectSums& sums) const {
  const std::size_t bands = quanta_.size();
  const std::size_t optics_count = model_.optics.size();
  std::vector<std::int64_t> scattered((layer_foliage_m2_.size() + 1) * bands);
  const auto add = [&](std::size_t level, std::size_t band, std::uint64_t landings, const QuantaSplit& split) {
    scattered[level * bands + band] += static_cast<std::int64_t>(landings) * (split.reflected + split.transmitted);
  };
  for (std::size_t b = 0; b < bands; ++b) {
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      if (!surfaces_.of[s].soil) continue;
      add(0, b, sums.surface[s].upper, split_of(surfaces_.of[s].optics, 0, b));
      add(0, b, sums.surface[s].lower, split_of(surfaces_.of[s].optics, 1, b));
    }
    if (model_.soil) add(0, b, sums.soil_plane, splits_[optics_count * 2 * bands + b]);
    for (std::size_t k = 0; k < sums.layer_optics.size(); ++k) {
      add(k / optics_count + 1, b, sums.layer_optics[k].upper, split_of(k % optics_count, 0, b));
      add(k / optics_count + 1, b, sums.layer_optics[k].lower, split_of(k % optics_count, 1, b));
    }
  }
  return scattered;
}

std::vector<std::int64_t> Tally::scattered_by_zone(const DirectSums& sums, const PlaneSums& passed) const {
  const std::size_t bands = quanta_.size();
  const std::size_t faces = model_.optics.size() * 2;
  if (!planes_) return {};
  std::vector<std::int64_t> scattered((model_.planes.size() + 1) * bands);
  const auto add = [&](std::size_t zone, std::size_t band, std::uint64_t landings, const QuantaSplit& split) {
    scattered[zone * bands + band] += static_cast<std::int64_t>(landings) * (split.reflected + split.transmitted);
  };
  for (std::size_t b = 0; b < bands; ++b) {
    for (std::size_t k = 0; k < passed.zone_landings.size(); ++k) {
      add(k / faces, b, passed.zone_landings[k], splits_[k % faces * bands + b]);
    }
    if (model_.soil) add(0, b, sums.soil_plane, splits_[faces * bands + b]);
  }
  return scattered;
}

void Tally::add(std::span<const std::uint32_t> counters, const DirectSums& sums, const PlaneSums& passed,
                const IndirectSums* indirect) {
  ++replicates_;
  lost_ += sums.lost;
  if (indirect != nullptr) {
    count_landed(*indirect);
    lost_ += indirect->lost;
    sky_rays_ += indirect->sky_rays;
    packets_ += indirect->packets;
    rounds_ += indirect->rounds;
  }
  add_to_ledgers(sums, indirect);
  add_to_band_means(sums, indirect);
  add_to_organ_means(sums, indirect);
  add_to_layer_means(sums, indirect);
  if (planes_) add_to_planes(passed, indirect);
  add_elements(counters, indirect);
}

// Throws Error (failure) if the sums over all replicates would overflow: light between mirrors can land that often.
void Tally::count_landed(const IndirectSums& indirect) {
  for (std::size_t b = 0; b < landed_.size(); ++b) {
    landed_[b] += landed_quanta(indirect, b);
    if (landed_[b] <= most_landed) continue;
    throw_failure(fmt::format("band {}: its light landed too often for the integer sums of {} replicates", model_.bands[b].name,
                              replicates_),
                  fmt::format("{:.3g} quanta, at most {:.3g} are possible", landed_[b], most_landed),
                  "lower reflectance + transmittance where surfaces enclose the light, or give fewer --passes");
  }
}

void Tally::add_to_planes(const PlaneSums& passed, const IndirectSums* indirect) {
  std::vector<double> per_ray, per_quantum;
  for (std::size_t b = 0; b < quanta_.size(); ++b) {
    per_ray.push_back(ground_per_ray_m2_ / model_.plot.area_m2() * beam_w_m2(b));
    per_quantum.push_back(quanta_[b].w_m2_per_quantum);
  }
  planes_->add(model_.has_beam() ? &passed : nullptr, indirect != nullptr ? &indirect->receivers : nullptr, per_ray,
               per_quantum);
}

void Tally::add_to_ledgers(const DirectSums& sums, const IndirectSums* indirect) {
  const std::vector<std::int64_t> waiting = scattered(sums);
  for (std::size_t b = 0; b < ledgers_.size(); ++b) {
    FluxLedger& ledger = ledgers_[b];
    const std::int64_t per_ray = quanta_[b].per_ray;
    ledger.incident += static_cast<std::int64_t>(model_.plot.periodic ? rays_ : sums.met + sums.lost) * per_ray;
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      const Surface& surface = surfaces_.of[s];
      (surface.soil ? ledger.absorbed_soil : ledger.absorbed_vegetation) +=
          static_cast<std::int64_t>(sums.surface[s].upper) * split_of(surface.optics, 0, b).absorbed +
          static_cast<std::int64_t>(sums.surface[s].lower) * split_of(surface.optics, 1, b).absorbed;
    }
    if (model_.soil) {
      const QuantaSplit& soil = splits_[model_.optics.size() * 2 * quanta_.size() + b];
      ledger.absorbed_soil += static_cast<std::int64_t>(sums.soil_plane) * soil.absorbed;
    }
    ledger.transmitted += static_cast<std::int64_t>(sums.transmitted) * per_ray;
    ledger.unshot += static_cast<std::int64_t>(sums.lost) * per_ray;
    if (indirect == nullptr) {
      for (std::size_t k = b; k < waiting.size(); k += ledgers_.size()) ledger.unshot += waiting[k];
      const std::int64_t other = quanta_[b].lamps + (model_.plot.periodic ? quanta_[b].sky : 0);
      ledger.incident += other;
      ledger.unshot += other;
      continue;
    }
    const FluxLedger& packets = indirect->ledger[b];
    ledger.incident += packets.incident;
    ledger.absorbed_vegetation += packets.absorbed_vegetation;
    ledger.absorbed_soil += packets.absorbed_soil;
    ledger.reflected += packets.reflected;
    ledger.transmitted += packets.transmitted;
    ledger.unshot += packets.unshot;
  }
}

void Tally::add_to_band_means(const DirectSums& sums, const IndirectSums* indirect) {
  const double share = ground_per_ray_m2_ / model_.plot.area_m2();
  std::uint64_t vegetation = 0;
  for (std::size_t s = 0; s < surfaces_.of.size(); ++s) vegetation += surfaces_.of[s].soil ? 0 : sums.surface[s].both();
  first_vegetation_.add(static_cast<double>(vegetation) * share);
  first_ground_.add(static_cast<double>(sums.ground) * share);
  met_.add(static_cast<double>(sums.met) * share);
  ground_ratio_.add(sums.met > 0 ? static_cast<double>(sums.ground) / static_cast<double>(sums.met) : 0.0);
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    double first_vegetation = 0.0;
    double first_soil = model_.soil ? (1.0 - model_.soil->reflectance[b]) * static_cast<double>(sums.soil_plane) : 0.0;
    for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
      const Surface& surface = surfaces_.of[s];
      (surface.soil ? first_soil : first_vegetation) +=
          static_cast<double>(sums.surface[s].upper) * absorptance(surface.optics, 0, b) +
          static_cast<double>(sums.surface[s].lower) * absorptance(surface.optics, 1, b);
    }
    const FluxLedger packets = indirect != nullptr ? indirect->ledger[b] : FluxLedger{};
    const double per_quantum = quanta_[b].w_m2_per_quantum;
    const double indirect_vegetation = static_cast<double>(packets.absorbed_vegetation) * per_quantum;
    const double indirect_soil = static_cast<double>(packets.absorbed_soil) * per_quantum;
    const double direct = share * beam_w_m2(b);
    bands_[b].vegetation.add(first_vegetation * direct + indirect_vegetation);
    bands_[b].soil.add(first_soil * direct + indirect_soil);
    bands_[b].indirect_vegetation.add(indirect_vegetation);
    bands_[b].indirect_soil.add(indirect_soil);
    bands_[b].reflected.add(static_cast<double>(packets.reflected) * per_quantum);
    bands_[b].transmitted.add(static_cast<double>(sums.transmitted) * direct +
                              static_cast<double>(packets.transmitted) * per_quantum);
  }
}

void Tally::add_to_organ_means(const DirectSums& sums, const IndirectSums* indirect) {
  const std::size_t bands = bands_.size();
  const std::size_t organs = organs_.size();
  std::vector<double> landed(organs);
  std::vector<double> direct_absorbed(organs * bands), indirect_landed(organs * bands), indirect_absorbed(organs * bands);
  for (std::size_t s = 0; s < surfaces_.of.size(); ++s) {
    const Surface& surface = surfaces_.of[s];
    const double sides[2] = {static_cast<double>(sums.surface[s].upper), static_cast<double>(sums.surface[s].lower)};
    landed[surface.organ] += sides[0] + sides[1];
    for (std::size_t b = 0; b < bands; ++b) {
      const std::size_t place = surface.organ * bands + b;
      for (std::size_t side = 0; side < 2; ++side) {
        direct_absorbed[place] += sides[side] * absorptance(surface.optics, side, b);
        if (indirect == nullptr) continue;
        const auto quanta = static_cast<double>(indirect->surface_landed[(s * 2 + side) * bands + b]);
        indirect_landed[place] += quanta;
        indirect_absorbed[place] += quanta * absorptance(surface.optics, side, b);
      }
    }
  }
  for (std::size_t o = 0; o < organs; ++o) {
    const double per_area = organ_area_m2_[o] > 0.0 ? 1.0 / organ_area_m2_[o] : 0.0;
    organs_[o].landed.add(landed[o] * ground_per_ray_m2_ * per_area);
    organs_[o].sunlit.add(sums.organ_lit_m2[o] * (organ_facing_m2_[o] > 0.0 ? 1.0 / organ_facing_m2_[o] : 0.0));
    for (std::size_t b = 0; b < bands; ++b) {
      const double direct = ground_per_ray_m2_ * beam_w_m2(b) * per_area;
      const double per_quantum = quanta_[b].w_m2_per_quantum * model_.plot.area_m2() * per_area;
      const std::size_t place = o * bands + b;
      organs_[o].direct[b].add(landed[o] * direct);
      organs_[o].indirect[b].add(indirect_landed[place] * per_quantum);
      organs_[o].absorbed[b].add(direct_absorbed[place] * direct + indirect_absorbed[place] * per_quantum);
      organs_[o].indirect_absorbed[b].add(indirect_absorbed[place] * per_quantum);
    }
  }
}

void Tally::add_to_layer_means(const DirectSums& sums, const IndirectSums* indirect) {
  const std::size_t optics_count = model_.optics.size();
  const std::size_t bands = bands_.size();
  const std::size_t count = layer_foliage_m2_.size();
  const double share = ground_per_ray_m2_ / model_.plot.area_m2();
  std::uint64_t below = sums.ground;
  double lit_m2 = 0.0;
  for (std::size_t k = 0; k <= count; ++k) {
    LayerMeans& layer = layers_[k];
    layer.ratio.add(sums.met > 0 ? static_cast<double>(below) / static_cast<double>(sums.met) : 0.0);
    for (std::size_t b = 0; b < bands; ++b) {
      const double per_quantum = quanta_[b].w_m2_per_quantum;
      const auto passed = [&](const std::vector<std::int64_t>& planes) {
        return static_cast<double>(planes[k * bands + b]) * per_quantum;
      };
      layer.down[b].add(static_cast<double>(below) * share * beam_w_m2(b) +
                        (indirect != nullptr ? passed(indirect->down) : 0.0));
      layer.up[b].add(indirect != nullptr ? passed(indirect->up) : 0.0);
      if (k == count) continue;
      double absorbed = 0.0;
      for (std::size_t o = 0; o < optics_count; ++o) {
        const Landings& landings = sums.layer_optics[k * optics_count + o];
        const double sides[2] = {static_cast<double>(landings.upper), static_cast<double>(landings.lower)};
        for (std::size_t side = 0; side < 2; ++side) {
          double flux = sides[side] * share * beam_w_m2(b);
          if (indirect != nullptr) {
            flux += static_cast<double>(indirect->layer_landed[((k * optics_count + o) * 2 + side) * bands + b]) * per_quantum;
          }
          absorbed += flux * absorptance(o, side, b);
        }
      }
      layer.absorbed[b].add(absorbed);
    }
    if (k == count) break;
    lit_m2 += sums.layer_lit_m2[k];
    layer.sunlit.add(layer_facing_m2_[k] > 0.0 ? sums.layer_lit_m2[k] / layer_facing_m2_[k] : 0.0);
    for (std::size_t o = 0; o < optics_count; ++o) below += sums.layer_optics[k * optics_count + o].both();
  }
  sunlit_.add(facing_m2_ > 0.0 ? lit_m2 / facing_m2_ : 0.0);
}

}  // namespace sunfleck

#include "base/error.h"
#include "transport/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Half-widths of a share from here on mean that nothing is known but that it lies between 0 and 1.
constexpr double unknown_share = 1.0 - 1e-9;

// Figures are judged against at least this share of the incident flux (design: an aggregate below 1 % is judged against that
// 1 %).
constexpr double least_judged_share = 0.01;

// Organs are judged if they receive at least this share of the mean organ's flux.
constexpr double least_judged_organ = 0.1;

// Confidence intervals of single elements stay empty below this many landings (validation G2: a normal interval on fewer
// hits too seldom covers the true value).
constexpr std::uint64_t least_landings = 20;

}  // namespace

// Returns how much the events that may have escaped all replicates would add to a mean if each adds `event` in its
// replicate.
double Tally::unseen(double event, double confidence) const {
  return unseen_events(confidence) * event / static_cast<double>(replicates_);
}

double Tally::relative_error(const ReplicateMean& mean, double least, double unseen, double quantile) const {
  return mean.estimate(quantile, unseen).half_width / std::max(mean.mean(), least);
}

double Tally::half_width(const Spread& spread, double quantile) const {
  const auto n = static_cast<double>(replicates_);
  return quantile * std::sqrt(std::max(0.0, spread.squares - spread.sum * spread.sum / n) / (n - 1.0) / n);
}

// Returns the flux that may still be absorbed, relative to the flux absorbed.
double Tally::unshot_share(std::size_t band) const {
  const FluxLedger& ledger = ledgers_[band];
  const auto absorbed = static_cast<double>(ledger.absorbed_vegetation + ledger.absorbed_soil);
  return absorbed > 0.0 ? static_cast<double>(ledger.unshot) / absorbed : 0.0;
}

void JudgedError::raise(double other, const JudgedFigure& of) {
  if (!(other > relative)) return;
  relative = other;
  figure = of;
}

JudgedError Tally::direct_error(const Accuracy& accuracy) const {
  const double quantile = t_quantile(accuracy.confidence, replicates_);
  if (std::isnan(quantile)) return {none, {}};
  JudgedError largest;
  const double least = least_judged_share * met_.mean();
  if (!(least > 0.0)) return largest;
  // Without vegetation in its way the whole beam is known to reach the ground.
  const double one_ray = beam_meets_vegetation_ ? unseen(events_.beam_share, accuracy.confidence) : 0.0;
  largest.raise(relative_error(first_vegetation_, least, one_ray, quantile), {.of = JudgedFigure::Of::vegetation});
  largest.raise(relative_error(first_ground_, least, one_ray, quantile), {.of = JudgedFigure::Of::soil});
  if (accuracy.of == ErrorTarget::organ) {
    const JudgedError organs = organ_error(quantile, false);
    largest.raise(organs.relative, organs.figure);
  }
  if (accuracy.of == ErrorTarget::triangle) {
    largest.raise(element_rms_error(quantile, direct_spread_, 0), {.of = JudgedFigure::Of::triangles});
  }
  return largest;
}

JudgedError Tally::indirect_error(const Accuracy& accuracy) const {
  const double quantile = t_quantile(accuracy.confidence, replicates_);
  if (std::isnan(quantile)) return {none, {}};
  JudgedError largest;
  const auto n = static_cast<double>(replicates_);
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const double per_quantum = quanta_[b].w_m2_per_quantum;
    const double least = least_judged_share * static_cast<double>(ledgers_[b].incident) * per_quantum / n;
    if (!(least > 0.0)) continue;
    const double unshot = static_cast<double>(ledgers_[b].unshot) * per_quantum / n;
    const double one_packet = unseen(events_.other_w_m2[b], accuracy.confidence);
    const auto judge = [&](const ReplicateMean& mean, double absorptance, JudgedFigure::Of of) {
      const double half_width = mean.estimate(quantile, one_packet * absorptance).half_width;
      largest.raise((half_width + unshot) / std::max(mean.mean(), least), {.of = of, .band = b});
    };
    judge(bands_[b].indirect_vegetation, vegetation_absorptance_[b], JudgedFigure::Of::vegetation);
    judge(bands_[b].indirect_soil, soil_absorptance_[b], JudgedFigure::Of::soil);
  }
  if (accuracy.of == ErrorTarget::organ) {
    const JudgedError organs = organ_error(quantile, true);
    largest.raise(organs.relative, organs.figure);
  }
  if (accuracy.of == ErrorTarget::triangle && !indirect_spread_.empty()) {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      largest.raise(element_rms_error(quantile, indirect_spread_, b * elements_.size()),
                    {.of = JudgedFigure::Of::triangles, .band = b});
    }
  }
  return largest;
}

// Returns the largest relative half-width of the organs' beam landings, or of their absorption of all other light.
JudgedError Tally::organ_error(double quantile, bool indirect) const {
  std::vector<bool> soil(organs_.size());
  for (const Surface& surface : surfaces_.of) soil[surface.organ] = soil[surface.organ] || surface.soil;
  JudgedError largest;
  for (std::size_t b = 0; b < (indirect ? bands_.size() : 1); ++b) {
    const auto mean_of = [&](std::size_t o) -> const ReplicateMean& {
      return indirect ? organs_[o].indirect_absorbed[b] : organs_[o].landed;
    };
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t o = 0; o < organs_.size(); ++o) {
      if (soil[o]) continue;
      sum += mean_of(o).mean() * organ_area_m2_[o];
      count += 1.0;
    }
    for (std::size_t o = 0; o < organs_.size(); ++o) {
      const double flux = mean_of(o).mean() * organ_area_m2_[o];
      if (soil[o] || flux <= 0.0 || flux < least_judged_organ * sum / count) continue;
      const double error = quantile * mean_of(o).standard_error() / mean_of(o).mean();
      JudgedFigure figure{.of = JudgedFigure::Of::organ, .organ = o};
      if (indirect) figure.band = b;
      largest.raise(error + (indirect ? unshot_share(b) : 0.0), figure);
    }
  }
  return largest;
}

// Returns the root-mean-square half-width relative to the mean. `spreads` are those of the elements' landings or of their W
// m-2, one per element from `first` on; the latter are multiplied by the element's area.
double Tally::element_rms_error(double quantile, const std::vector<Spread>& spreads, std::size_t first) const {
  if (spreads.empty()) return none;
  const bool landings = &spreads == &direct_spread_;
  double area = 0.0;
  double flux = 0.0;
  double squares = 0.0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const double element_m2 = area_m2(model_.canopy.corners[e]);
    if (surfaces_.of[surfaces_.number_of[e]].soil || element_m2 <= 0.0) continue;
    const double to_flux = landings ? 1.0 : element_m2;
    const double half = half_width(spreads[first + e], quantile) * to_flux;
    area += element_m2;
    flux += spreads[first + e].sum * to_flux / static_cast<double>(replicates_);
    squares += half * half / element_m2;
  }
  return flux > 0.0 ? std::sqrt(squares / area) * area / flux : 0.0;
}

void Tally::add_elements(std::span<const std::uint32_t> counters, const IndirectSums* indirect) {
  const std::size_t bands = bands_.size();
  for (std::size_t cell = 0; cell < soil_cells_.size(); ++cell)
    soil_cells_[cell] += counters[shared::counter_first_cell + cell];
  if (indirect != nullptr) {
    side_landed_.resize(indirect->side_landed.size());
    cell_landed_.resize(indirect->cell_landed.size());
    for (std::size_t k = 0; k < side_landed_.size(); ++k) side_landed_[k] += indirect->side_landed[k];
    for (std::size_t k = 0; k < cell_landed_.size(); ++k) cell_landed_[k] += indirect->cell_landed[k];
    side_sky_.resize(indirect->side_sky.size());
    cell_sky_.resize(indirect->cell_sky.size());
    for (std::size_t k = 0; k < side_sky_.size(); ++k) side_sky_[k] += indirect->side_sky[k];
    for (std::size_t k = 0; k < cell_sky_.size(); ++k) cell_sky_[k] += indirect->cell_sky[k];
  }
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Landings landings = element_landings(counters, e);
    elements_[e].upper += landings.upper;
    elements_[e].lower += landings.lower;
    if (element_errors_ == ElementErrors::skip) continue;
    direct_spread_[e].add(static_cast<double>(landings.both()));
    element_hits_[e] += landings.both() + (indirect != nullptr ? indirect->element_hits[e] : 0);
    const double element_m2 = area_m2(model_.canopy.corners[e]);
    const double per_area = element_m2 > 0.0 ? 1.0 / element_m2 : 0.0;
    const double sides[2] = {static_cast<double>(landings.upper), static_cast<double>(landings.lower)};
    for (std::size_t b = 0; b < bands; ++b) {
      double absorbed = 0.0;
      double landed = 0.0;
      for (std::size_t side = 0; side < 2; ++side) {
        double other = 0.0;
        if (indirect != nullptr) {
          other = static_cast<double>(indirect->side_landed[(2 * e + side) * bands + b]) * quanta_[b].w_m2_per_quantum *
                  model_.plot.area_m2() * per_area;
        }
        landed += other;
        const double incident = sides[side] * ground_per_ray_m2_ * beam_w_m2(b) * per_area + other;
        absorbed += incident * absorptance(model_.canopy.optics_of[e], side, b);
        if (!side_spread_.empty()) side_spread_[(2 * e + side) * bands + b].add(incident);
      }
      absorbed_spread_[b * elements_.size() + e].add(absorbed);
      if (!indirect_spread_.empty()) indirect_spread_[b * elements_.size() + e].add(landed);
    }
  }
}

BandResult Tally::band_result(std::size_t band, double confidence) const {
  const FluxLedger& ledger = ledgers_[band];
  if (ledger.residual() != 0) {
    throw_failure(fmt::format("band {}: the flux ledger misses {} quanta", model_.bands[band].name, ledger.residual()),
                  "incident must equal absorbed + reflected + transmitted + unshot",
                  "run it with --device cpu, and report the device and the scene");
  }
  const double per_quantum = quanta_[band].w_m2_per_quantum / std::max(1.0, static_cast<double>(replicates_));
  BandResult result;
  result.name = model_.bands[band].name;
  result.ledger = ledger;
  result.incident = static_cast<double>(ledger.incident) * per_quantum;
  result.unshot = static_cast<double>(ledger.unshot) * per_quantum;
  const double quantile = t_quantile(confidence, replicates_);
  const auto estimate = [&](std::int64_t quanta, const ReplicateMean& mean, double event_w_m2) {
    const Estimate of_mean = mean.estimate(quantile, unseen(event_w_m2, confidence));
    return Estimate{static_cast<double>(quanta) * per_quantum, of_mean.half_width + result.unshot};
  };
  const double any = events_.largest_w_m2(band);
  const double packet = scatters(model_, band) ? events_.other_w_m2[band] : 0.0;
  const double beam = beam_meets_vegetation_ ? events_.beam_w_m2[band] : 0.0;
  const double fallen = !model_.soil ? std::max(beam, events_.other_w_m2[band]) : !model_.plot.periodic ? packet : 0.0;
  result.absorbed_vegetation =
      estimate(ledger.absorbed_vegetation, bands_[band].vegetation, any * vegetation_absorptance_[band]);
  result.absorbed_soil = estimate(ledger.absorbed_soil, bands_[band].soil, any * soil_absorptance_[band]);
  result.reflected = estimate(ledger.reflected, bands_[band].reflected, packet);
  result.transmitted = estimate(ledger.transmitted, bands_[band].transmitted, fallen);
  return result;
}

// Returns the share of `facing_m2` in direct sun. Its interval follows from the spread of `mean` or, where that is zero,
// from `parts`. Both numbers are NaN if the beam can hit none of the area, or so little of it that any share would agree
// with what the rays met.
Estimate Tally::sunlit_estimate(const ReplicateMean& mean, double facing_m2, std::vector<FacingArea> parts,
                                double confidence) const {
  if (!(facing_m2 > 0.0)) return {none, none};
  const bool agree = replicates_ >= 2 && mean.squares() == 0.0;
  if (!agree) return mean.estimate(t_quantile(confidence, replicates_));
  const double unseen_share = unseen_sunlit_m2(std::move(parts), unseen(1.0, confidence)) / facing_m2;
  return unseen_share < unknown_share ? Estimate{mean.mean(), unseen_share} : Estimate{none, none};
}

// Returns the parts of each organ about which all replicates agree: [organ]; empty for the other organs.
std::vector<std::vector<FacingArea>> Tally::agreed_organs() const {
  std::vector<std::vector<FacingArea>> parts(organs_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const std::size_t organ = model_.canopy.organ_of[e];
    if (organs_[organ].sunlit.squares() > 0.0 || !exposure_.can_hit(e)) continue;
    parts[organ].push_back({area_m2(model_.canopy.corners[e]), exposure_.lit_m2_per_landing(e)});
  }
  return parts;
}

// Returns the same for the foliage in each layer: [layer].
std::vector<std::vector<FacingArea>> Tally::agreed_layers() const {
  const std::size_t count = layer_foliage_m2_.size();
  std::vector<std::vector<FacingArea>> parts(count);
  const auto agree = [&](std::size_t k) { return layer_facing_m2_[k] > 0.0 && layers_[k].sunlit.squares() == 0.0; };
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) any = any || agree(k);
  std::vector<double> area_in_layer_m2(count);
  for (std::size_t e = 0; any && e < elements_.size(); ++e) {
    if (!foliage_[e] || !exposure_.can_hit(e)) continue;
    const Triangle& corners = model_.canopy.corners[e];
    add_area_by_layer(layout_.layers, corners, area_in_layer_m2);
    const std::size_t first = first_layer(layout_, corners);
    for (std::size_t k = first; k < first + layout_.first_bin[e + 1] - layout_.first_bin[e]; ++k) {
      if (agree(k)) parts[k].push_back({area_in_layer_m2[k], exposure_.lit_m2_per_landing(e)});
      area_in_layer_m2[k] = 0.0;
    }
  }
  return parts;
}

// Returns the same for all foliage.
std::vector<FacingArea> Tally::agreed_foliage() const {
  std::vector<FacingArea> parts;
  for (std::size_t e = 0; sunlit_.squares() == 0.0 && e < elements_.size(); ++e) {
    if (!foliage_[e] || !exposure_.can_hit(e)) continue;
    parts.push_back({area_m2(model_.canopy.corners[e]), exposure_.lit_m2_per_landing(e)});
  }
  return parts;
}

// Returns how much one beam ray changes a share of the rays that meet the scene, in one replicate.
double Tally::share_of_one_ray() const {
  return beam_meets_vegetation_ && met_.mean() > 0.0 ? events_.beam_share / met_.mean() : 0.0;
}

std::vector<OrganResult> Tally::organ_results(double confidence) const {
  const double quantile = t_quantile(confidence, replicates_);
  std::vector<std::vector<FacingArea>> parts = agreed_organs();
  std::vector<OrganResult> results;
  for (std::size_t o = 0; o < organs_.size(); ++o) {
    OrganResult result;
    result.area_m2 = organ_area_m2_[o];
    result.sunlit_fraction = sunlit_estimate(organs_[o].sunlit, organ_facing_m2_[o], std::move(parts[o]), confidence);
    const double per_area = organ_area_m2_[o] > 0.0 ? model_.plot.area_m2() / organ_area_m2_[o] : 0.0;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const double absorptance = organ_absorptance_[o * bands_.size() + b];
      const double beam = organ_facing_m2_[o] > 0.0 ? events_.beam_w_m2[b] : 0.0;
      const double other = absorptance > 0.0 ? events_.other_w_m2[b] : 0.0;
      const auto one = [&](double event_w_m2) { return unseen(event_w_m2 * per_area, confidence); };
      result.direct.push_back(organs_[o].direct[b].estimate(quantile, one(beam)));
      result.indirect.push_back(organs_[o].indirect[b].estimate(quantile, one(other)));
      result.absorbed.push_back(organs_[o].absorbed[b].estimate(quantile, one(std::max(beam, other) * absorptance)));
      result.absorbed.back().half_width += result.absorbed.back().value * unshot_share(b);
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<LayerResult> Tally::layer_results(double confidence) const {
  const double quantile = t_quantile(confidence, replicates_);
  const std::size_t count = layer_foliage_m2_.size();
  std::vector<std::vector<FacingArea>> parts = agreed_layers();
  const double one_ray = unseen(share_of_one_ray(), confidence);
  std::vector<LayerResult> results;
  for (std::size_t k = 0; k <= count; ++k) {
    const LayerMeans& means = layers_[k];
    LayerResult result;
    result.height_m = layout_.layers.height_m * static_cast<double>(k) / static_cast<double>(count);
    const bool below_top = k < count;
    result.sunfleck_ratio = {none, none};
    if (model_.has_beam()) result.sunfleck_ratio = means.ratio.estimate(quantile, below_top ? one_ray : 0.0);
    result.sunlit_leaf_fraction = {none, none};
    if (below_top) {
      result.leaf_area_index = layer_foliage_m2_[k] / model_.plot.area_m2();
      result.sunlit_leaf_fraction = sunlit_estimate(means.sunlit, layer_facing_m2_[k], std::move(parts[k]), confidence);
    }
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const double any = std::max(beam_meets_vegetation_ ? events_.beam_w_m2[b] : 0.0, events_.other_w_m2[b]);
      const double packet = scatters(model_, b) ? events_.other_w_m2[b] : 0.0;
      result.down.push_back(means.down[b].estimate(quantile, unseen(below_top ? any : 0.0, confidence)));
      result.up.push_back(means.up[b].estimate(quantile, unseen(packet, confidence)));
      if (!below_top) continue;
      const double absorbed = layer_holds_vegetation_[k] ? any * vegetation_absorptance_[b] : 0.0;
      result.absorbed.push_back(means.absorbed[b].estimate(quantile, unseen(absorbed, confidence)));
      result.absorbed.back().half_width += result.absorbed.back().value * unshot_share(b);
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<double> Tally::element_errors(double quantile) const {
  std::vector<double> errors;
  errors.reserve(absorbed_spread_.size());
  for (std::size_t b = 0; b < bands_.size() && !absorbed_spread_.empty(); ++b) {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const Spread& spread = absorbed_spread_[b * elements_.size() + e];
      const bool enough = element_hits_[e] >= least_landings;
      const double mean = spread.sum / static_cast<double>(replicates_);
      errors.push_back(enough ? half_width(spread, quantile) + mean * unshot_share(b) : none);
    }
  }
  return errors;
}

std::vector<double> Tally::side_errors(double quantile) const {
  std::vector<double> errors;
  errors.reserve(side_spread_.size());
  for (std::size_t place = 0; place < side_spread_.size(); ++place) {
    const std::size_t bands = bands_.size();
    const double mean = side_spread_[place].sum / static_cast<double>(replicates_);
    // If no light fell on a side its error is unknown, however often the other side was hit.
    const bool enough = mean > 0.0 && element_hits_[place / bands / 2] >= least_landings;
    errors.push_back(enough ? half_width(side_spread_[place], quantile) + mean * unshot_share(place % bands) : none);
  }
  return errors;
}

RadiationResult Tally::result(double confidence) const {
  const double quantile = t_quantile(confidence, replicates_);
  RadiationResult result;
  for (std::size_t b = 0; b < model_.bands.size(); ++b) {
    result.bands.push_back(band_result(b, confidence));
    result.w_per_quantum.push_back(quanta_[b].w_m2_per_quantum * model_.plot.area_m2() /
                                   std::max(1.0, static_cast<double>(replicates_)));
  }
  result.organs = organ_results(confidence);
  result.layers = layer_results(confidence);
  result.elements = elements_;
  result.element_error = element_errors(quantile);
  result.side_error = side_errors(quantile);
  result.soil_cells = soil_cells_;
  result.side_indirect = side_landed_;
  result.cell_indirect = cell_landed_;
  result.side_sky = side_sky_;
  result.cell_sky = cell_sky_;
  if (planes_) {
    std::vector<double> events_w_m2;
    for (std::size_t b = 0; b < bands_.size(); ++b) events_w_m2.push_back(events_.largest_w_m2(b));
    result.planes = planes_->results(quantile, unseen_events(confidence), events_w_m2);
  }
  result.sunlit_leaf_fraction = sunlit_estimate(sunlit_, facing_m2_, agreed_foliage(), confidence);
  if (!model_.has_beam())
    result.ground_sunfleck_ratio = {none, none};
  else
    result.ground_sunfleck_ratio = ground_ratio_.estimate(quantile, unseen(share_of_one_ray(), confidence));
  result.leaf_area_index = foliage_m2_ / model_.plot.area_m2();
  result.ground_per_ray_m2 = replicates_ > 0 ? ground_per_ray_m2_ / static_cast<double>(replicates_) : 0.0;
  result.lost_rays = lost_;
  result.indirect.sky_rays = sky_rays_;
  result.indirect.packets = packets_;
  result.indirect.rounds = rounds_;
  return result;
}

}  // namespace sunfleck

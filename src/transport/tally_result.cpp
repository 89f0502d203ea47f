#include "base/error.h"
#include "transport/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunfleck {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Judged against at least this share of the incident flux (design: an aggregate below 1 % is judged against that 1 %).
constexpr double least_judged_share = 0.01;

// Organs are judged from this share of the mean organ's flux upwards.
constexpr double least_judged_organ = 0.1;

// Confidence intervals of single elements stay empty below this many landings (validation G2: a normal interval on fewer hits
// covers too seldom).
constexpr std::uint64_t least_landings = 20;

double relative_to(const ReplicateMean& mean, double least, double quantile) {
  return quantile * mean.standard_error() / std::max(mean.mean(), least);
}

}  // namespace

double Tally::half_width(const Spread& spread, double quantile) const {
  const auto n = static_cast<double>(replicates_);
  return quantile * std::sqrt(std::max(0.0, spread.squares - spread.sum * spread.sum / n) / (n - 1.0) / n);
}

// What may still be absorbed, relative to what was.
double Tally::unshot_share(std::size_t band) const {
  const FluxLedger& ledger = ledgers_[band];
  const auto absorbed = static_cast<double>(ledger.absorbed_vegetation + ledger.absorbed_soil);
  return absorbed > 0.0 ? static_cast<double>(ledger.unshot) / absorbed : 0.0;
}

double Tally::direct_error(const Accuracy& accuracy) const {
  const double quantile = t_quantile(accuracy.confidence, replicates_);
  if (std::isnan(quantile)) return none;
  const double least = least_judged_share * met_.mean();
  if (!(least > 0.0)) return 0.0;
  const double canopy = std::max(relative_to(first_vegetation_, least, quantile), relative_to(first_ground_, least, quantile));
  if (accuracy.of == ErrorTarget::organ) return std::max(canopy, organ_error(quantile, false));
  if (accuracy.of == ErrorTarget::triangle) return std::max(canopy, element_rms_error(quantile, direct_spread_, 0));
  return canopy;
}

double Tally::indirect_error(const Accuracy& accuracy) const {
  const double quantile = t_quantile(accuracy.confidence, replicates_);
  if (std::isnan(quantile)) return none;
  double largest = 0.0;
  const auto n = static_cast<double>(replicates_);
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const double per_quantum = quanta_[b].w_m2_per_quantum;
    const double least = least_judged_share * static_cast<double>(ledgers_[b].incident) * per_quantum / n;
    if (!(least > 0.0)) continue;
    const double unshot = static_cast<double>(ledgers_[b].unshot) * per_quantum / n;
    for (const ReplicateMean* mean : {&bands_[b].indirect_vegetation, &bands_[b].indirect_soil}) {
      largest = std::max(largest, (quantile * mean->standard_error() + unshot) / std::max(mean->mean(), least));
    }
  }
  if (accuracy.of == ErrorTarget::organ) return std::max(largest, organ_error(quantile, true));
  if (accuracy.of == ErrorTarget::triangle && !indirect_spread_.empty()) {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      largest = std::max(largest, element_rms_error(quantile, indirect_spread_, b * elements_.size()));
    }
  }
  return largest;
}

// The largest relative half-width of the organs' beam landings, or of what they absorb of all other light.
double Tally::organ_error(double quantile, bool indirect) const {
  std::vector<bool> soil(organs_.size());
  for (const Surface& surface : surfaces_.of) soil[surface.organ] = soil[surface.organ] || surface.soil;
  double largest = 0.0;
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
      largest = std::max(largest, relative_to(mean_of(o), 0.0, quantile) + (indirect ? unshot_share(b) : 0.0));
    }
  }
  return largest;
}

// Spreads of the elements' flux: landings, or W m-2 of element times area, from `first` on.
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

BandResult Tally::band_result(std::size_t band, double quantile) const {
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
  const auto estimate = [&](std::int64_t quanta, const ReplicateMean& mean) {
    return Estimate{static_cast<double>(quanta) * per_quantum, quantile * mean.standard_error() + result.unshot};
  };
  result.absorbed_vegetation = estimate(ledger.absorbed_vegetation, bands_[band].vegetation);
  result.absorbed_soil = estimate(ledger.absorbed_soil, bands_[band].soil);
  result.reflected = estimate(ledger.reflected, bands_[band].reflected);
  result.transmitted = estimate(ledger.transmitted, bands_[band].transmitted);
  return result;
}

std::vector<OrganResult> Tally::organ_results(double quantile) const {
  std::vector<OrganResult> results;
  for (std::size_t o = 0; o < organs_.size(); ++o) {
    OrganResult result;
    result.area_m2 = organ_area_m2_[o];
    result.sunlit_fraction = organs_[o].sunlit.estimate(quantile);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      result.direct.push_back(organs_[o].direct[b].estimate(quantile));
      result.indirect.push_back(organs_[o].indirect[b].estimate(quantile));
      result.absorbed.push_back(organs_[o].absorbed[b].estimate(quantile));
      result.absorbed.back().half_width += result.absorbed.back().value * unshot_share(b);
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<LayerResult> Tally::layer_results(double quantile) const {
  std::vector<LayerResult> results;
  const std::size_t count = layer_foliage_m2_.size();
  for (std::size_t k = 0; k <= count; ++k) {
    const LayerMeans& means = layers_[k];
    LayerResult result;
    result.height_m = layout_.layers.height_m * static_cast<double>(k) / static_cast<double>(count);
    result.sunfleck_ratio = model_.has_beam() ? means.ratio.estimate(quantile) : Estimate{none, none};
    result.sunlit_leaf_fraction = {none, none};
    if (k < count) {
      result.leaf_area_index = layer_foliage_m2_[k] / model_.plot.area_m2();
      if (layer_foliage_m2_[k] > 0.0 && model_.has_beam()) result.sunlit_leaf_fraction = means.sunlit.estimate(quantile);
    }
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      result.down.push_back(means.down[b].estimate(quantile));
      result.up.push_back(means.up[b].estimate(quantile));
      if (k == count) continue;
      result.absorbed.push_back(means.absorbed[b].estimate(quantile));
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
    // A side that nothing fell on tells nothing, however often the other was hit.
    const bool enough = mean > 0.0 && element_hits_[place / bands / 2] >= least_landings;
    errors.push_back(enough ? half_width(side_spread_[place], quantile) + mean * unshot_share(place % bands) : none);
  }
  return errors;
}

RadiationResult Tally::result(double confidence) const {
  const double quantile = t_quantile(confidence, replicates_);
  RadiationResult result;
  for (std::size_t b = 0; b < model_.bands.size(); ++b) {
    result.bands.push_back(band_result(b, quantile));
    result.w_per_quantum.push_back(quanta_[b].w_m2_per_quantum * model_.plot.area_m2() /
                                   std::max(1.0, static_cast<double>(replicates_)));
  }
  result.organs = organ_results(quantile);
  result.layers = layer_results(quantile);
  result.elements = elements_;
  result.element_error = element_errors(quantile);
  result.side_error = side_errors(quantile);
  result.soil_cells = soil_cells_;
  result.side_indirect = side_landed_;
  result.cell_indirect = cell_landed_;
  result.side_sky = side_sky_;
  result.cell_sky = cell_sky_;
  if (planes_) result.planes = planes_->results(quantile);
  result.sunlit_leaf_fraction = sunlit_.estimate(quantile);
  result.ground_sunfleck_ratio = model_.has_beam() ? ground_ratio_.estimate(quantile) : Estimate{none, none};
  result.leaf_area_index = foliage_m2_ / model_.plot.area_m2();
  result.ground_per_ray_m2 = replicates_ > 0 ? ground_per_ray_m2_ / static_cast<double>(replicates_) : 0.0;
  result.lost_rays = lost_;
  result.indirect.sky_rays = sky_rays_;
  result.indirect.packets = packets_;
  result.indirect.rounds = rounds_;
  return result;
}

}  // namespace sunfleck

#include "physics/transport/solve/run_sums.h"

#include "base/units.h"

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

// Confidence intervals of single elements stay empty below this many landings (validation G2: a normal interval on fewer
// hits too seldom covers the true value).
constexpr std::uint64_t least_landings = 20;

}  // namespace

double Spread::half_width(double t_quantile, std::size_t replicates) const {
  const auto n = static_cast<double>(replicates);
  return t_quantile * std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1.0) / n);
}

RunSums::RunSums(const Conversion& of, ElementErrors element_errors, ShadeGroups shade_groups, Lights lights)
    : conversion(of),
      has_sky(of.model.has_sky() || any_sky(lights)),
      has_packets(has_sky || scatters(of.model)),
      landed(of.quanta.size()),
      sky_landed(of.quanta.size()),
      first_waiting(of.quanta.size()),
      ledgers(of.quanta.size()),
      bands(of.quanta.size()),
      classes(of, shade_groups),
      elements(of.model.canopy.size()),
      soil_cells(of.layout.cells()) {
  const RadiationModel& model = of.model;
  OrganMeans organ;
  for (auto* means : {&organ.direct, &organ.indirect, &organ.absorbed, &organ.indirect_absorbed}) means->resize(bands.size());
  organs.assign(model.canopy.organs.size(), organ);
  PlantMeans plant;
  for (auto* means : {&plant.incident, &plant.absorbed}) means->resize(bands.size());
  plants.assign(of.areas.plants.size(), plant);
  LayerMeans layer;
  for (auto* means : {&layer.down, &layer.up, &layer.absorbed, &layer.absorbed_structure}) means->resize(bands.size());
  layers.assign(static_cast<std::size_t>(of.layout.layers.count) + 1, layer);
  if (of.receivers != nullptr) planes.emplace(*of.receivers, model);
  keeps_half = refines(element_errors);
  if (keeps_half) half_elements.resize(elements.size());
  if (!keeps_spreads(element_errors)) return;
  direct_spread.resize(elements.size());
  element_hits.resize(elements.size());
  absorbed_spread.resize(elements.size() * bands.size());
  if (has_packets) indirect_spread.resize(elements.size() * bands.size());
  if (element_errors != ElementErrors::keep) side_spread.resize(2 * elements.size() * bands.size());
}

double RunSums::unshot_w_m2(std::size_t band) const {
  return static_cast<double>(ledgers[band].unshot) * conversion.quanta[band].w_m2_per_quantum /
         std::max(1.0, static_cast<double>(replicates));
}

double RunSums::unshot_share_of_scattered(std::size_t band) const {
  constexpr double most_times_its_share = 2.0;
  if (!(first_waiting[band] > 0.0)) return ledgers[band].unshot_share();
  return most_times_its_share * static_cast<double>(ledgers[band].unshot) / first_waiting[band];
}

double RunSums::unseen(double event, double confidence) const {
  return unseen_events(confidence) * event / static_cast<double>(replicates);
}

LightEvents RunSums::events(double confidence) const {
  LightEvents events = conversion.events;
  if (replicates == 0) return events;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double waited = first_waiting[b] * conversion.quanta[b].w_m2_per_quantum / static_cast<double>(replicates);
    const double one_landing = events.scattering[b] * std::max(events.beam_w_m2[b], events.sky_w_m2[b]);
    events.start_w_m2[b] = std::min(events.start_w_m2[b], waited + unseen(one_landing, confidence));
  }
  return events;
}

std::vector<double> RunSums::element_errors(double t_quantile) const {
  std::vector<double> errors;
  errors.reserve(absorbed_spread.size());
  for (std::size_t place = 0; place < absorbed_spread.size(); ++place) {
    const Spread& spread = absorbed_spread[place];
    const double mean = spread.sum / static_cast<double>(replicates);
    const bool enough = element_hits[place % elements.size()] >= least_landings;
    const double unshot_share = ledgers[place / elements.size()].unshot_share();
    errors.push_back(enough ? spread.half_width(t_quantile, replicates) + mean * unshot_share : no_value);
  }
  return errors;
}

std::vector<double> RunSums::side_errors(double t_quantile) const {
  std::vector<double> errors;
  errors.reserve(side_spread.size());
  for (std::size_t place = 0; place < side_spread.size(); ++place) {
    const Spread& spread = side_spread[place];
    const double mean = spread.sum / static_cast<double>(replicates);
    // If no light fell on a side its error is unknown, however often the other side was hit.
    const bool enough = mean > 0.0 && element_hits[place / bands.size() / 2] >= least_landings;
    const double unshot_share = ledgers[place % bands.size()].unshot_share();
    errors.push_back(enough ? spread.half_width(t_quantile, replicates) + mean * unshot_share : no_value);
  }
  return errors;
}

}  // namespace sunfleck

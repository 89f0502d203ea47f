#include "physics/transport/indirect/conversion.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace sunfleck {
namespace {

// Returns how a ray's quanta split on each face. The rounding is the same for every ray; it is one quantum in some ten
// million.
std::vector<QuantaSplit> split_rays(const RadiationModel& model, const std::vector<BandQuanta>& quanta) {
  constexpr std::uint32_t middle = 0x80000000U;
  std::vector<QuantaSplit> splits;
  for (const SurfaceOptics& optics : model.optics) {
    for (const auto* face : {&optics.upper, &optics.lower}) {
      for (std::size_t b = 0; b < quanta.size(); ++b) {
        splits.push_back(
            split_quanta(quanta[b].per_ray, split_coefficients((*face)[b].reflectance, (*face)[b].transmittance), middle));
      }
    }
  }
  for (std::size_t b = 0; model.soil && b < quanta.size(); ++b) {
    splits.push_back(split_quanta(quanta[b].per_ray, split_coefficients(model.soil->reflectance[b], 0.0), middle));
  }
  return splits;
}

std::vector<double> all_absorptances(const RadiationModel& model) {
  std::vector<double> absorptances;
  for (const SurfaceOptics& optics : model.optics) {
    for (const auto* face : {&optics.upper, &optics.lower}) {
      for (std::size_t b = 0; b < model.bands.size(); ++b) absorptances.push_back((*face)[b].absorptance());
    }
  }
  return absorptances;
}

// Returns the elements with landings, in ascending order. Most elements have none in a replicate, and counters that are 0 are
// passed over many at a time.
std::vector<std::uint32_t> elements_with_landings(const CounterLayout& layout, std::span<const std::uint32_t> counters) {
  constexpr std::size_t at_a_time = 16;
  const std::span<const std::uint32_t> bins = counters.subspan(layout.first_bin_word, 2 * std::size_t{layout.first_bin.back()});
  std::vector<std::uint32_t> elements;
  std::uint32_t element = 0;
  for (std::size_t first = 0; first < bins.size(); first += at_a_time) {
    const std::span<const std::uint32_t> some = bins.subspan(first, std::min(at_a_time, bins.size() - first));
    if (std::accumulate(some.begin(), some.end(), 0U, std::bit_or()) == 0) continue;
    for (std::size_t k = 0; k < some.size(); ++k) {
      if (some[k] == 0) continue;
      while (layout.first_bin[element + 1] <= (first + k) / 2) ++element;
      if (elements.empty() || elements.back() != element) elements.push_back(element);
    }
  }
  return elements;
}

// What vegetation as a whole is judged against at least, as a share of what it would receive with nothing around it; the same
// number is the least share of the plot that its area is taken as.
constexpr double least_exposed_share = 1e-3;
// And as a share of what it absorbs in all.
constexpr double least_absorbed_share = 0.01;

}  // namespace

Conversion::Conversion(const RadiationModel& of_model, const CounterLayout& of_layout, const Surfaces& of_surfaces,
                       const CanopyAreas& of_areas, const PlaneReceivers* plane_receivers, const Incidence& incidence)
    : model(of_model),
      layout(of_layout),
      surfaces(of_surfaces),
      receivers(plane_receivers),
      rays(incidence.rays),
      ground_per_ray_m2(incidence.ground_per_ray_m2),
      quanta(make_band_quanta(model, incidence)),
      events(make_light_events(model, quanta, incidence)),
      exposure(model, layout, incidence.ground_per_ray_m2),
      areas(of_areas),
      absorptances_(all_absorptances(model)),
      splits_(split_rays(model, quanta)) {}

BeamLandings Conversion::element_landings(std::span<const std::uint32_t> counters, std::size_t element) const {
  BeamLandings landings;
  for (std::uint32_t bin = layout.first_bin[element]; bin < layout.first_bin[element + 1]; ++bin) {
    landings.upper += counters[layout.first_bin_word + 2 * bin];
    landings.lower += counters[layout.first_bin_word + 2 * bin + 1];
  }
  return landings;
}

DirectSums Conversion::sum(std::span<const std::uint32_t> counters) const {
  DirectSums sums;
  sums.surface.resize(surfaces.of.size());
  sums.layer_optics.resize(areas.layer_foliage_m2.size() * model.optics.size());
  sums.organ_lit_m2.resize(areas.organ_m2.size());
  sums.layer_lit_m2.resize(areas.layer_foliage_m2.size());
  sums.plant_lit_m2.resize(areas.plants.size());
  sums.transmitted = counters[shared::counter_transmitted];
  sums.missed = counters[shared::counter_missed];
  sums.lost = counters[shared::counter_lost];
  for (std::uint32_t cell = 0; cell < layout.cells(); ++cell) sums.soil_plane += counters[shared::counter_first_cell + cell];
  sum_elements(counters, sums);
  sums.met = model.plot.periodic ? rays : counters[shared::counter_met];
  sums.ground = sums.soil_plane + sums.transmitted;
  for (std::size_t s = 0; s < surfaces.of.size(); ++s) sums.ground += surfaces.of[s].soil() ? sums.surface[s].both() : 0;
  check(sums);
  return sums;
}

void Conversion::sum_elements(std::span<const std::uint32_t> counters, DirectSums& sums) const {
  sums.hit = elements_with_landings(layout, counters);
  for (const std::uint32_t e : sums.hit) {
    const BeamLandings element = element_landings(counters, e);
    const std::uint32_t number = surfaces.number_of[e];
    const Surface& surface = surfaces.of[number];
    sums.surface[number] += element;
    const double lit_m2 = static_cast<double>(element.both()) * double{exposure.lit_m2_per_landing(e)};
    sums.organ_lit_m2[surface.organ] += lit_m2;
    const std::uint32_t plant = areas.plants.of_surface[number];
    if (areas.foliage[e] && plant != PlantAreas::no_plant) sums.plant_lit_m2[plant] += lit_m2;
    if (surface.soil()) continue;
    const std::size_t first = first_layer(layout, model.canopy.corners[e]);
    std::uint32_t bin = layout.first_bin[e];
    for (std::size_t layer = first; layer < layout.end_layer(e, first); ++layer, ++bin) {
      const std::uint32_t upper = counters[layout.first_bin_word + 2 * bin];
      const std::uint32_t lower = counters[layout.first_bin_word + 2 * bin + 1];
      sums.layer_optics[layer * model.optics.size() + surface.optics] += {upper, lower};
      if (areas.foliage[e]) sums.layer_lit_m2[layer] += (1.0 * upper + lower) * double{exposure.lit_m2_per_landing(e)};
    }
  }
}

void Conversion::check(const DirectSums& sums) const {
  std::uint64_t landed = sums.soil_plane + sums.transmitted + sums.lost;
  for (const BeamLandings& surface : sums.surface) landed += surface.both();
  const std::uint64_t sent = model.plot.periodic ? rays : sums.met + sums.lost;
  const std::uint64_t followed = model.plot.periodic ? rays : sent + sums.missed;
  if (landed == sent && followed == rays) return;
  throw_failure(fmt::format("direct pass: {} of {} rays landed, {} were followed", landed, sent, followed),
                "every ray sent must land, leave or be counted as lost",
                "run it with --device cpu, and report the device and the scene");
}

double Conversion::least_share_of_vegetation() const {
  return least_exposed_share * std::clamp(areas.vegetation_m2 / model.plot.area_m2(), least_exposed_share, 1.0);
}

double Conversion::least_of_vegetation_w_m2(std::size_t band) const {
  const double absorptance = areas.vegetation_absorptance[band];
  if (absorptance <= 0.0) return std::numeric_limits<double>::infinity();
  const double lamps_w_m2 = static_cast<double>(quanta[band].lamps) * quanta[band].w_m2_per_quantum;
  const double sky_w_m2 = model.has_sky() ? model.bands[band].diffuse_w_m2 : 0.0;
  return least_share_of_vegetation() * absorptance * (beam_w_m2(band) + sky_w_m2 + lamps_w_m2);
}

std::vector<double> Conversion::least_of_vegetation(const DirectSums& sums) const {
  std::vector<double> least;
  for (std::size_t b = 0; b < quanta.size(); ++b) {
    double absorbed = 0.0;
    for (std::size_t s = 0; s < surfaces.of.size(); ++s) {
      const Surface& surface = surfaces.of[s];
      if (!is_vegetation(surface.role)) continue;
      absorbed += static_cast<double>(sums.surface[s].upper) * static_cast<double>(split(surface.optics, 0, b).absorbed) +
                  static_cast<double>(sums.surface[s].lower) * static_cast<double>(split(surface.optics, 1, b).absorbed);
    }
    least.push_back(std::max(least_absorbed_share * absorbed, least_of_vegetation_w_m2(b) / quanta[b].w_m2_per_quantum));
  }
  return least;
}

std::int64_t Conversion::scattered_of(const BeamLandings& landings, std::size_t optics, std::size_t band) const {
  return static_cast<std::int64_t>(landings.upper) * split(optics, 0, band).scattered() +
         static_cast<std::int64_t>(landings.lower) * split(optics, 1, band).scattered();
}

// `landings` are [place * optics + optics]; the first of them lie in place `first` of `places`, the soil plane in place 0.
std::vector<std::int64_t> Conversion::scattered_by_place(std::span<const BeamLandings> landings, std::size_t first,
                                                         std::size_t places, std::uint64_t soil_plane) const {
  const std::size_t bands = quanta.size();
  const std::size_t optics = model.optics.size();
  std::vector<std::int64_t> scattered(places * bands);
  for (std::size_t b = 0; b < bands; ++b) {
    for (std::size_t k = 0; k < landings.size(); ++k) {
      scattered[(first + k / optics) * bands + b] += scattered_of(landings[k], k % optics, b);
    }
    if (model.soil) scattered[b] += static_cast<std::int64_t>(soil_plane) * soil_split(b).scattered();
  }
  return scattered;
}

std::vector<std::int64_t> Conversion::scattered(const DirectSums& sums) const {
  const std::size_t levels = areas.layer_foliage_m2.size() + 1;
  std::vector<std::int64_t> scattered = scattered_by_place(sums.layer_optics, 1, levels, sums.soil_plane);
  for (std::size_t s = 0; s < surfaces.of.size(); ++s) {
    const Surface& surface = surfaces.of[s];
    for (std::size_t b = 0; surface.soil() && b < quanta.size(); ++b) {
      scattered[b] += scattered_of(sums.surface[s], surface.optics, b);
    }
  }
  return scattered;
}

std::vector<std::int64_t> Conversion::scattered_by_zone(const DirectSums& sums, const PlaneSums& passed) const {
  if (receivers == nullptr) return {};
  return scattered_by_place(passed.zone_landings, 0, receivers->size() + 1, sums.soil_plane);
}

}  // namespace sunfleck

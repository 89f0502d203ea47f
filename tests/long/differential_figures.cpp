#include "long/differential_figures.h"

#include "physics/canopy/triangle.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace sunfleck::test::differential {
namespace {

// Returns the flux that is still unshot, relative to the absorbed flux. The errors of finer figures include this share of their
// value.
double unshot_share(const RadiationResult& result, std::size_t band) {
  const FluxLedger& ledger = result.bands[band].ledger;
  const auto absorbed = static_cast<double>(ledger.absorbed());
  return absorbed > 0.0 ? static_cast<double>(ledger.unshot) / absorbed : 0.0;
}

// Returns all light on a side, W m-2.
double side_w_m2(const RadiationModel& model, const RadiationResult& result, std::size_t side, std::size_t band) {
  const BeamLandings& element = result.elements[side / 2];
  const double area = area_m2(model.canopy.corners[side / 2]);
  const double beam_w_m2 = model.has_beam() ? model.bands[band].direct_w_m2 : 0.0;
  return result.irradiance_w_m2(side % 2 == 0 ? element.upper : element.lower, area, beam_w_m2) +
         result.side_indirect_w_m2(side, area, band);
}

double element_absorbed_w_m2(const RadiationModel& model, const RadiationResult& result, std::size_t element,
                             std::size_t band) {
  const SurfaceOptics& optics = model.optics[model.canopy.optics_of[element]];
  return side_w_m2(model, result, 2 * element, band) * optics.upper[band].absorptance() +
         side_w_m2(model, result, 2 * element + 1, band) * optics.lower[band].absorptance();
}

const char* word(Of of) {
  switch (of) {
    case Of::absorbed_vegetation:
      return "absorbed by vegetation";
    case Of::absorbed_structure:
      return "absorbed by structures";
    case Of::absorbed_soil:
      return "absorbed by soil";
    case Of::reflected:
      return "reflected";
    case Of::transmitted:
      return "transmitted";
    case Of::sunlit_leaves:
      return "sunlit share of leaves";
    case Of::sunlit_ground:
      return "sunfleck ratio of the ground";
    case Of::organ_sunlit:
      return "sunlit share of organ";
    case Of::organ_direct:
      return "direct light on organ";
    case Of::organ_indirect:
      return "indirect light on organ";
    case Of::organ_absorbed:
      return "absorbed by organ";
    case Of::element_absorbed:
      return "absorbed by element";
    case Of::side:
      return "light on side";
    case Of::row_ratio:
      return "sunfleck ratio of row";
    case Of::row_sunlit:
      return "sunlit share of row";
    case Of::row_down:
      return "light down in row";
    case Of::row_up:
      return "light up in row";
    case Of::row_absorbed:
      return "absorbed in row";
    case Of::row_structure:
      return "absorbed by structures in row";
    case Of::plane_ratio:
      return "sunfleck ratio of plane";
    case Of::plane_down:
      return "light down through plane";
    case Of::sensor_direct:
      return "direct light at sensor";
    case Of::sensor_sky:
      return "sky light at sensor";
    case Of::sensor_scattered:
      return "scattered light at sensor";
  }
  return "";
}

}  // namespace

std::vector<Figure> figures_of(const RadiationModel& model) {
  std::vector<Figure> figures;
  const auto add = [&](std::initializer_list<Of> all, std::size_t places, std::size_t bands) {
    for (const Of of : all) {
      for (std::size_t place = 0; place < places; ++place) {
        for (std::size_t band = 0; band < bands; ++band) figures.push_back({of, place, band});
      }
    }
  };
  const std::size_t bands = model.bands.size();
  const auto rows = static_cast<std::size_t>(model.layers);
  add({Of::absorbed_vegetation, Of::absorbed_structure, Of::absorbed_soil, Of::reflected, Of::transmitted}, 1, bands);
  add({Of::sunlit_leaves, Of::sunlit_ground}, 1, 1);
  add({Of::organ_sunlit}, model.canopy.organs.size(), 1);
  add({Of::organ_direct, Of::organ_indirect, Of::organ_absorbed}, model.canopy.organs.size(), bands);
  add({Of::element_absorbed}, model.canopy.size(), bands);
  add({Of::side}, 2 * model.canopy.size(), bands);
  add({Of::row_ratio}, rows + 1, 1);
  add({Of::row_sunlit}, rows, 1);
  add({Of::row_down, Of::row_up}, rows + 1, bands);
  add({Of::row_absorbed, Of::row_structure}, rows, bands);
  add({Of::plane_ratio}, model.planes.size(), 1);
  add({Of::plane_down}, model.planes.size(), bands);
  add({Of::sensor_direct, Of::sensor_sky, Of::sensor_scattered}, model.sensors.size(), bands);
  return figures;
}

std::string name_of(const RadiationModel& model, const Figure& figure) {
  return fmt::format("{} {}, band {} of {}", word(figure.of), figure.place, figure.band, model.bands.size());
}

Stated stated(const RadiationModel& model, const RadiationResult& result, const Figure& figure, double quantile) {
  const std::size_t place = figure.place;
  const std::size_t band = figure.band;
  const auto plain = [&](const Estimate& estimate) { return Stated{estimate.value, estimate.half_width / quantile}; };
  const auto less = [&](Estimate estimate, double unshot) {
    estimate.half_width -= unshot;
    return plain(estimate);
  };
  const auto finer = [&](const Estimate& estimate) { return less(estimate, estimate.value * unshot_share(result, band)); };
  const BandResult& total = result.bands[band];
  switch (figure.of) {
    case Of::absorbed_vegetation:
      return less(total.absorbed_vegetation, total.unshot);
    case Of::absorbed_structure:
      return less(total.absorbed_structure, std::min(total.unshot, total.absorbed_structure.half_width));
    case Of::absorbed_soil:
      return less(total.absorbed_soil, total.unshot);
    case Of::reflected:
      return less(total.reflected, total.unshot);
    case Of::transmitted:
      return less(total.transmitted, total.unshot);
    case Of::sunlit_leaves:
      return plain(result.sunlit_leaf_fraction);
    case Of::sunlit_ground:
      return plain(result.ground_sunfleck_ratio);
    case Of::organ_sunlit:
      return plain(result.organs[place].sunlit_fraction);
    case Of::organ_direct:
      return plain(result.organs[place].direct[band]);
    case Of::organ_indirect:
      return plain(result.organs[place].indirect[band]);
    case Of::organ_absorbed:
      return finer(result.organs[place].absorbed[band]);
    case Of::element_absorbed:
      return finer(
          {element_absorbed_w_m2(model, result, place, band), result.element_error[band * model.canopy.size() + place]});
    case Of::side:
      return finer({side_w_m2(model, result, place, band), result.side_error[place * model.bands.size() + band]});
    case Of::row_ratio:
      return plain(result.layers[place].sunfleck_ratio);
    case Of::row_sunlit:
      return plain(result.layers[place].sunlit_leaf_fraction);
    case Of::row_down:
      return plain(result.layers[place].down[band]);
    case Of::row_up:
      return plain(result.layers[place].up[band]);
    case Of::row_absorbed:
      return finer(result.layers[place].absorbed[band]);
    case Of::row_structure:
      return finer(result.layers[place].absorbed_structure[band]);
    case Of::plane_ratio:
      return plain(result.planes[place].sunfleck_ratio);
    case Of::plane_down:
      return plain(result.planes[place].total_down[band]);
    case Of::sensor_direct:
      return plain(result.sensors[place][0].direct[band]);
    case Of::sensor_sky:
      return plain(result.sensors[place][0].sky[band]);
    case Of::sensor_scattered:
      return plain(result.sensors[place][0].scattered[band]);
  }
  return {};
}

}  // namespace sunfleck::test::differential

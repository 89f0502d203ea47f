#include "programs/tradeoff/tradeoff_values.h"

#include "base/units.h"
#include "files/results/tables/irradiance.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/surfaces.h"

#include <algorithm>

namespace sunfleck {
namespace {

constexpr std::size_t canopy = static_cast<std::size_t>(Quantity::canopy);
constexpr std::size_t layer = static_cast<std::size_t>(Quantity::layer);
constexpr std::size_t organ = static_cast<std::size_t>(Quantity::organ);
constexpr std::size_t triangle = static_cast<std::size_t>(Quantity::triangle);

void add(QuantityValues& values, const Estimate& estimate) {
  values.value.push_back(estimate.value);
  values.half_width.push_back(estimate.half_width);
}

// Flux absorbed where the beam first lands, W per m2 of ground.
struct DirectAbsorbed {
  double vegetation = 0.0, structure = 0.0, soil = 0.0;
};

DirectAbsorbed direct_absorbed(const RadiationModel& model, const RadiationResult& result, const Surfaces& surfaces,
                               std::size_t band) {
  const double per_landing = result.ground_per_ray_m2 * model.bands[band].direct_w_m2 / model.plot.area_m2();
  DirectAbsorbed absorbed;
  if (!model.has_beam()) return absorbed;
  for (std::size_t e = 0; e < result.elements.size(); ++e) {
    const SurfaceOptics& optics = model.optics[model.canopy.optics_of[e]];
    const Role role = surfaces.at(e).role;
    (role == Role::soil    ? absorbed.soil
     : is_vegetation(role) ? absorbed.vegetation
                           : absorbed.structure) +=
        per_landing * (static_cast<double>(result.elements[e].upper) * optics.upper[band].absorptance() +
                       static_cast<double>(result.elements[e].lower) * optics.lower[band].absorptance());
  }
  if (!model.soil) return absorbed;
  std::uint64_t landings = 0;
  for (const std::uint64_t cell : result.soil_cells) landings += cell;
  absorbed.soil += per_landing * static_cast<double>(landings) * (1.0 - model.soil->reflectance[band]);
  return absorbed;
}

void add_absorbed_triangles(const RadiationModel& model, const RadiationResult& result, QuantityValues& values) {
  const std::size_t elements = model.canopy.size();
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    for (std::size_t e = 0; e < elements; ++e) {
      const double element_m2 = area_m2(model.canopy.corners[e]);
      const double upper = side_irradiance(model, result, 2 * e, element_m2, b).total_w_m2();
      const double lower = side_irradiance(model, result, 2 * e + 1, element_m2, b).total_w_m2();
      add(values, {absorbed_w_m2(model.optics[model.canopy.optics_of[e]], upper, lower, b),
                   result.element_error.empty() ? no_value : result.element_error[b * elements + e]});
    }
  }
}

// Values of 0, such as those of layers without leaves, are not judged: they would make the others look better.
QuantityNorm against_incident(const std::vector<double>& values, const std::vector<double>& incident, auto band_of) {
  QuantityNorm norm;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double scale = std::max(values[i], least_judged_share * incident[band_of(i)]);
    norm.scale.push_back(scale);
    norm.weight.push_back(scale > 0.0 && values[i] > 0.0 ? 1.0 : 0.0);
  }
  return norm;
}

struct Area {
  double m2 = 0.0;
  bool vegetation = true;
};

std::vector<Area> element_areas(const RadiationModel& model) {
  const Surfaces surfaces(model);
  const Canopy& elements = model.canopy;
  std::vector<Area> areas;
  areas.reserve(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    areas.push_back({area_m2(elements.corners[e]), is_vegetation(surfaces.at(e).role)});
  }
  return areas;
}

QuantityNorm organ_norm(const Canopy& elements, const std::vector<Area>& areas, const std::vector<double>& values,
                        std::size_t bands) {
  std::vector<Area> organs(elements.organs.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    Area& of_organ = organs[elements.organ_of[e]];
    of_organ.m2 += areas[e].m2;
    of_organ.vegetation = of_organ.vegetation && areas[e].vegetation;
  }
  QuantityNorm norm{std::vector<double>(values.size()), values};
  for (std::size_t b = 0; b < bands; ++b) {
    double flux_w = 0.0;
    double count = 0.0;
    for (std::size_t o = 0; o < organs.size(); ++o) {
      if (!organs[o].vegetation) continue;
      flux_w += values[o * bands + b] * organs[o].m2;
      count += 1.0;
    }
    for (std::size_t o = 0; o < organs.size(); ++o) {
      const double organ_w = values[o * bands + b] * organs[o].m2;
      const bool judged = organs[o].vegetation && organ_w > 0.0 && organ_w >= least_judged_organ * flux_w / count;
      norm.weight[o * bands + b] = judged ? 1.0 : 0.0;
    }
  }
  return norm;
}

QuantityNorm triangle_norm(const std::vector<Area>& areas, const std::vector<double>& values, std::size_t bands) {
  QuantityNorm norm{std::vector<double>(values.size()), std::vector<double>(values.size(), 1.0)};
  if (areas.empty()) return norm;
  for (std::size_t b = 0; b < bands; ++b) {
    const std::size_t first = b * areas.size();
    double area_sum_m2 = 0.0;
    double flux_w = 0.0;
    for (std::size_t e = 0; e < areas.size(); ++e) {
      if (!areas[e].vegetation) continue;
      area_sum_m2 += areas[e].m2;
      flux_w += areas[e].m2 * values[first + e];
    }
    if (!(flux_w > 0.0)) continue;
    for (std::size_t e = 0; e < areas.size(); ++e) {
      norm.weight[first + e] = areas[e].vegetation ? areas[e].m2 : 0.0;
      norm.scale[first + e] = flux_w / area_sum_m2;
    }
  }
  return norm;
}

}  // namespace

RadiationModel direct_light_model(const RadiationModel& model) {
  RadiationModel black = model;
  black.bands = {{"direct", 1.0, 0.0, 0.0}};
  black.sky.reset();
  black.planes.clear();
  black.sensors.clear();
  for (SurfaceOptics& optics : black.optics) {
    optics.upper = optics.lower = {FaceOptics{}};
    optics.emission_w_m2.clear();
  }
  if (black.soil) black.soil->reflectance = {0.0};
  return black;
}

RunValues absorbed_values(const RadiationModel& model, const RadiationResult& result) {
  RunValues values;
  for (const BandResult& band : result.bands) {
    add(values[canopy], band.absorbed_vegetation);
    add(values[canopy], band.absorbed_soil);
  }
  for (std::size_t k = 0; k + 1 < result.layers.size(); ++k) {
    for (const Estimate& absorbed : result.layers[k].absorbed) add(values[layer], absorbed);
  }
  for (const OrganResult& one : result.organs) {
    for (const Estimate& absorbed : one.absorbed) add(values[organ], absorbed);
  }
  add_absorbed_triangles(model, result, values[triangle]);
  return values;
}

RunValues indirect_values(const RadiationModel& model, const RadiationResult& result) {
  RunValues values;
  const Surfaces surfaces(model);
  const double relative = result.indirect.relative_error.value_or(no_value);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const DirectAbsorbed direct = direct_absorbed(model, result, surfaces, b);
    const double least = least_judged_share * result.bands[b].incident.value;
    for (const double value :
         {result.bands[b].absorbed_vegetation.value - direct.vegetation, result.bands[b].absorbed_soil.value - direct.soil}) {
      add(values[canopy], {value, relative * std::max(value, least)});
    }
  }
  for (const LayerResult& plane : result.layers) {
    for (const Estimate& up : plane.up) add(values[layer], up);
  }
  for (const OrganResult& one : result.organs) {
    for (const Estimate& indirect : one.indirect) add(values[organ], indirect);
  }
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    for (std::size_t e = 0; e < model.canopy.size(); ++e) {
      const double element_m2 = area_m2(model.canopy.corners[e]);
      add(values[triangle],
          {result.side_indirect_w_m2(2 * e, element_m2, b) + result.side_indirect_w_m2(2 * e + 1, element_m2, b), no_value});
    }
  }
  return values;
}

RunNorms make_norms(const RadiationModel& model, const RunValues& values, const std::vector<double>& incident) {
  const std::size_t bands = model.bands.size();
  const std::vector<Area> areas = element_areas(model);
  RunNorms norms;
  norms[canopy] = against_incident(values[canopy].value, incident, [](std::size_t i) { return i / 2; });
  norms[layer] = against_incident(values[layer].value, incident, [bands](std::size_t i) { return i % bands; });
  norms[organ] = organ_norm(model.canopy, areas, values[organ].value, bands);
  norms[triangle] = triangle_norm(areas, values[triangle].value, bands);
  return norms;
}

std::vector<double> incident_w_m2(const RadiationResult& result) {
  std::vector<double> incident;
  for (const BandResult& band : result.bands) incident.push_back(band.incident.value);
  return incident;
}

}  // namespace sunfleck

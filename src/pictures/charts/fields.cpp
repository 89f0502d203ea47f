#include "pictures/charts/fields.h"

#include "base/check.h"
#include "files/results/tables/irradiance.h"
#include "physics/light/sky.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sunfleck {
namespace {

Colour colour_of(const glm::dvec3& rgb) {
  return {rgb.r, rgb.g, rgb.b};
}

double shown(LightField field, const Irradiance& light) {
  switch (field) {
    case LightField::direct:
      return light.direct_w_m2;
    case LightField::sky:
      return light.sky_w_m2;
    case LightField::indirect:
      return light.indirect_w_m2;
    case LightField::scattered:
      return light.scattered_w_m2();
    case LightField::total:
    case LightField::absorbed:
      return light.total_w_m2();
  }
  return 0.0;
}

struct FromAbove {
  double beam_w_m2 = 0.0, sky_w_m2 = 0.0;
};

// Returns the beam on a plane that faces it and the sky on a sphere.
FromAbove light_from_above(const RadiationModel& model, std::size_t band) {
  FromAbove light;
  if (model.has_beam()) light.beam_w_m2 = model.bands[band].direct_w_m2 / std::sin(model.sun->elevation_rad);
  if (model.has_sky()) light.sky_w_m2 = model.bands[band].diffuse_w_m2 * Sky(*model.sky, model.sun).spherical_irradiance();
  return light;
}

// Returns the largest irradiance of a side by light that surfaces send.
double largest_sent_w_m2(const RadiationModel& model, std::size_t band) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double sent = model.soil ? model.soil->reflectance[band] : 0.0;
  for (const SurfaceOptics& optics : model.optics) {
    if (optics.exitance_w_m2(band) > 0.0) return infinite;
    const FaceOptics &upper = optics.upper[band], &lower = optics.lower[band];
    sent = std::max({sent, upper.reflectance + lower.transmittance, lower.reflectance + upper.transmittance});
  }
  if (sent >= 1.0) return infinite;
  const FromAbove light = light_from_above(model, band);
  return (light.beam_w_m2 + light.sky_w_m2) * sent / (1.0 - sent);
}

// Returns what a field shows of all this light.
double largest_of(LightField field, const FromAbove& light, double sent_w_m2) {
  switch (field) {
    case LightField::direct:
      return light.beam_w_m2;
    case LightField::sky:
      return light.sky_w_m2;
    case LightField::scattered:
      return sent_w_m2;
    case LightField::indirect:
      return light.sky_w_m2 + sent_w_m2;
    case LightField::total:
    case LightField::absorbed:
      return light.beam_w_m2 + light.sky_w_m2 + sent_w_m2;
  }
  return 0.0;
}

}  // namespace

std::string field_title(LightField field, const std::string& band, bool of_both_faces) {
  const char* const unit = of_both_faces ? ", W m⁻² (both faces)" : ", W m⁻²";
  switch (field) {
    case LightField::direct:
      return fmt::format("Direct {} irradiance{}", band, unit);
    case LightField::sky:
      return fmt::format("{} irradiance from the sky{}", band, unit);
    case LightField::scattered:
      return fmt::format("Scattered {} irradiance{}", band, unit);
    case LightField::indirect:
      return fmt::format("Indirect {} irradiance{}", band, unit);
    case LightField::total:
      return fmt::format("Total {} irradiance{}", band, unit);
    case LightField::absorbed:
      return fmt::format("Absorbed {}, W m⁻² of one-sided area", band);
  }
  return "";
}

bool has_field(const RadiationModel& model, LightField field) {
  if (field == LightField::direct) return model.has_beam();
  if (field == LightField::sky) return model.has_sky();
  if (field == LightField::scattered) return scatters(model);
  const bool indirect = model.has_sky() || scatters(model);
  return field == LightField::indirect ? indirect : indirect || model.has_beam();
}

FieldValues field_values(const RadiationModel& model, const CounterLayout& layout, const RadiationResult& result,
                         std::size_t band, LightField field) {
  EXPECT(result.elements.size(), ==, model.canopy.size());
  EXPECT(result.soil_cells.size(), ==, std::size_t{layout.cells()});
  FieldValues values;
  values.first_cell = 2 * model.canopy.size();
  values.w_m2.reserve(2 * model.canopy.size() + layout.cells());
  values.area_m2.reserve(values.w_m2.capacity());
  const auto add = [&](double w_m2, double area) {
    values.w_m2.push_back(w_m2);
    values.area_m2.push_back(area);
  };
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const double area = area_m2(model.canopy.corners[e]);
    const double upper = shown(field, side_irradiance(model, result, 2 * e, area, band));
    const double lower = shown(field, side_irradiance(model, result, 2 * e + 1, area, band));
    if (field == LightField::absorbed) {
      const double absorbed = absorbed_w_m2(model.optics[model.canopy.optics_of[e]], upper, lower, band);
      add(absorbed, area);
      add(absorbed, area);
    } else {
      add(upper, area);
      add(lower, area);
    }
  }
  const double cell_m2 = layout.cells() > 0 ? model.plot.area_m2() / layout.cells() : 0.0;
  for (std::size_t cell = 0; cell < layout.cells(); ++cell) {
    const double incident = shown(field, cell_irradiance(model, result, cell, cell_m2, band));
    add(field == LightField::absorbed ? incident * (1.0 - model.soil->reflectance[band]) : incident, cell_m2);
  }
  return values;
}

FieldValues leaf_values(const RadiationModel& model, FieldValues of_sides, LightField field) {
  const Surfaces surfaces(model);
  const std::vector<double> area_m2 = of_sides.area_m2;
  std::fill(of_sides.area_m2.begin(), of_sides.area_m2.end(), 0.0);
  bool any = false;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    double& upper = of_sides.w_m2[2 * e];
    double& lower = of_sides.w_m2[2 * e + 1];
    if (field != LightField::absorbed) upper = lower = upper + lower;
    if (!is_vegetation(surfaces.at(e).role)) continue;
    of_sides.area_m2[2 * e] = area_m2[2 * e];
    any = any || area_m2[2 * e] > 0.0;
  }
  if (!any) of_sides.area_m2 = area_m2;
  return of_sides;
}

double lit_from_w_m2(const RadiationModel& model, std::size_t band, LightField field) {
  constexpr double unlit_share = 1e-3;
  const double beam = model.has_beam() ? model.bands[band].direct_w_m2 : 0.0;
  const double sky = model.has_sky() ? model.bands[band].diffuse_w_m2 : 0.0;
  if (field == LightField::direct) return unlit_share * beam;
  if (field == LightField::sky) return unlit_share * sky;
  double lamps_w = 0.0;
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    const double exitance_w_m2 = model.optics[model.canopy.optics_of[e]].exitance_w_m2(band);
    if (exitance_w_m2 > 0.0) lamps_w += exitance_w_m2 * area_m2(model.canopy.corners[e]);
  }
  return unlit_share * (beam + sky + lamps_w / model.plot.area_m2());
}

double largest_possible_w_m2(const RadiationModel& model, std::size_t band, LightField field, int faces) {
  return largest_of(field, light_from_above(model, band), faces * largest_sent_w_m2(model, band));
}

double largest_on_soil_w_m2(const RadiationModel& model, std::size_t band, LightField field) {
  FromAbove open_ground;
  if (model.has_beam()) open_ground.beam_w_m2 = model.bands[band].direct_w_m2;
  if (model.has_sky()) open_ground.sky_w_m2 = model.bands[band].diffuse_w_m2;
  const double sent_w_m2 = largest_sent_w_m2(model, band);
  if (field == LightField::absorbed && model.soil) {
    return (1.0 - model.soil->reflectance[band]) * largest_of(LightField::total, open_ground, sent_w_m2);
  }
  return largest_of(field, open_ground, sent_w_m2);
}

std::vector<Colour> surface_reflectance(const RadiationModel& model, const CounterLayout& layout) {
  std::vector<Colour> colours;
  colours.reserve(2 * model.canopy.size() + layout.cells());
  for (std::size_t e = 0; e < model.canopy.size(); ++e) {
    colours.insert(colours.end(), 2, colour_of(model.optics[model.canopy.optics_of[e]].rgb));
  }
  if (model.soil) colours.insert(colours.end(), layout.cells(), colour_of(model.soil->rgb));
  return colours;
}

}  // namespace sunfleck

#include "pictures/charts/fields.h"

#include "base/check.h"
#include "files/results/tables/irradiance.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

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

}  // namespace

std::string field_title(LightField field, const std::string& band) {
  switch (field) {
    case LightField::direct:
      return fmt::format("Direct {} irradiance, W m⁻²", band);
    case LightField::sky:
      return fmt::format("{} irradiance from the sky, W m⁻²", band);
    case LightField::scattered:
      return fmt::format("Scattered {} irradiance, W m⁻²", band);
    case LightField::indirect:
      return fmt::format("Indirect {} irradiance, W m⁻²", band);
    case LightField::total:
      return fmt::format("Total {} irradiance, W m⁻²", band);
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

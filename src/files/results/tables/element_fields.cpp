#include "files/results/tables/element_fields.h"

#include "base/check.h"
#include "base/in_blocks.h"
#include "base/units.h"
#include "files/results/tables/irradiance.h"
#include "physics/canopy/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sunfleck {
namespace {

constexpr std::size_t elements_per_block = 16384;

double value_of(LightColumn column, const Irradiance& upper, const Irradiance& lower, double absorbed_w_m2, double error_w_m2) {
  switch (column) {
    case LightColumn::direct_upper:
      return upper.direct_w_m2;
    case LightColumn::direct_lower:
      return lower.direct_w_m2;
    case LightColumn::sky_upper:
      return upper.sky_w_m2;
    case LightColumn::sky_lower:
      return lower.sky_w_m2;
    case LightColumn::indirect_upper:
      return upper.indirect_w_m2;
    case LightColumn::indirect_lower:
      return lower.indirect_w_m2;
    case LightColumn::total:
      return upper.total_w_m2() + lower.total_w_m2();
    case LightColumn::absorbed:
      return absorbed_w_m2;
    case LightColumn::absorbed_error:
      return error_w_m2;
  }
  return no_value;
}

struct LightLabel {
  const char* ending;
  const char* meaning;
};

// The names are in the order of the enumerators.
constexpr LightLabel light_labels[] = {
    {"direct_upper", "irradiance of the upper face by the sun's beam"},
    {"direct_lower", "irradiance of the lower face by the sun's beam"},
    {"sky_upper", "irradiance of the upper face by sky light at its first hit, a part of indirect"},
    {"sky_lower", "irradiance of the lower face by sky light at its first hit, a part of indirect"},
    {"indirect_upper", "irradiance of the upper face by all light but the sun's beam at its first hit"},
    {"indirect_lower", "irradiance of the lower face by all light but the sun's beam at its first hit"},
    {"total", "irradiance of both faces together by all light"},
    {"absorbed", "flux absorbed by both faces per one-sided area"},
    {"absorbed_error", "half-width of the confidence interval of what both faces absorb"}};

const LightLabel& label_of(LightColumn column) {
  return light_labels[static_cast<std::size_t>(column)];
}

std::vector<LightColumn> columns_of(const RadiationResult& result) {
  std::vector<LightColumn> columns = {LightColumn::direct_upper, LightColumn::direct_lower};
  if (!result.side_sky.empty()) columns.insert(columns.end(), {LightColumn::sky_upper, LightColumn::sky_lower});
  columns.insert(columns.end(), {LightColumn::indirect_upper, LightColumn::indirect_lower, LightColumn::total,
                                 LightColumn::absorbed, LightColumn::absorbed_error});
  return columns;
}

// Returns whether the errors of some triangles are unknown, as they are where the counts themselves are shown.
bool lacks_errors(const ElementFields& fields) {
  const auto lacks = [](const std::vector<LightValues>& band) {
    const std::vector<double>& errors = band.back().values;
    return std::any_of(errors.begin(), errors.end(), [](double error) { return std::isnan(error); });
  };
  return std::any_of(fields.light.begin(), fields.light.end(), lacks);
}

}  // namespace

const char* ending(LightColumn column) {
  return label_of(column).ending;
}

const char* meaning(LightColumn column) {
  return label_of(column).meaning;
}

ElementFields make_element_places(const RadiationModel& model) {
  const Canopy& canopy = model.canopy;
  ElementFields fields;
  fields.axes = model.plot.axes;
  std::map<std::string, std::int32_t> kind_of_name;
  std::vector<std::int32_t> kind_of_organ;  // [organ]
  for (const Organ& organ : canopy.organs) {
    const auto [found, is_new] = kind_of_name.emplace(organ.name, static_cast<std::int32_t>(fields.organ_names.size()));
    if (is_new) fields.organ_names.push_back(organ.name);
    kind_of_organ.push_back(found->second);
  }
  fields.optics_names = canopy.optics_names;
  fields.plant.resize(canopy.size());
  fields.rank.resize(canopy.size());
  fields.organ.resize(canopy.size());
  fields.optics.resize(canopy.size());
  fields.area_m2.resize(canopy.size());
  for (std::vector<double>& along : fields.centroid_m) along.resize(canopy.size());
  each_in_blocks(canopy.size(), elements_per_block, [&](std::size_t e) {
    const Organ& organ = canopy.organs[canopy.organ_of[e]];
    fields.plant[e] = organ.plant;
    fields.rank[e] = organ.rank;
    fields.organ[e] = kind_of_organ[canopy.organ_of[e]];
    fields.optics[e] = canopy.optics_of[e];
    const Triangle& corners = canopy.corners[e];
    fields.area_m2[e] = area_m2(corners);
    const glm::dvec3 sum = glm::dvec3(corners[0]) + glm::dvec3(corners[1]) + glm::dvec3(corners[2]);
    const glm::dvec3 centroid_m = user_position_m(model.plot, sum / 3.0 + canopy.origin_m);
    for (int axis = 0; axis < 3; ++axis) fields.centroid_m[static_cast<std::size_t>(axis)][e] = centroid_m[axis];
  });
  return fields;
}

ElementFields make_element_fields(const RadiationModel& model, const RadiationResult& result) {
  EXPECT(result.elements.size(), ==, model.canopy.size());
  ElementFields fields = make_element_places(model);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    std::vector<LightValues>& columns = fields.light.emplace_back();
    for (const LightColumn column : columns_of(result)) {
      columns.push_back(
          {column, fmt::format("{}_{}", model.bands[b].name, ending(column)), std::vector<double>(fields.size())});
    }
    each_in_blocks(fields.size(), elements_per_block, [&](std::size_t e) {
      const Irradiance upper = side_irradiance(model, result, 2 * e, fields.area_m2[e], b);
      const Irradiance lower = side_irradiance(model, result, 2 * e + 1, fields.area_m2[e], b);
      const double absorbed = absorbed_w_m2(model.optics[model.canopy.optics_of[e]], upper.total_w_m2(), lower.total_w_m2(), b);
      const double error = result.element_error.empty() ? no_value : result.element_error[b * fields.size() + e];
      for (LightValues& column : columns) column.values[e] = value_of(column.column, upper, lower, absorbed, error);
    });
  }
  return fields;
}

Table triangles_table(const ElementFields& fields) {
  constexpr unsigned all = in_csv | in_arrays | in_netcdf | in_meshes;
  Table table{"Triangles, in the order of the files",
              fmt::format("area_m2: m2, one-sided; x, y, z: m, centroid after wrapping ({}); direct, sky (unscattered, "
                          "a part of indirect), indirect: W m-2 incident on the face; absorbed: W m-2, both faces; _error: "
                          "half-width of the confidence interval{}",
                          axes_text(fields.axes), lacks_errors(fields) ? ", empty below 20 hits" : ""),
              {fields.size()}};
  table.columns.push_back({.name = "triangle",
                           .unit = "1",
                           .meaning = "number of the triangle, in the order of the files",
                           .outputs = all & ~in_arrays,
                           .values = RowNumbers{fields.size()}});
  table.add_view({"plant", "1", "number of the plant, 0 for soil", all}, fields.plant);
  table.add_view({"rank", "1", "leaf number from the ground, 0 for organs without one", all}, fields.rank);
  table.add_view({"organ", "1", "kind of organ", all, {}, fields.organ_names}, fields.organ);
  table.add_view({"optics", "1", "optics of the surface", all, {}, fields.optics_names}, fields.optics);
  table.add_view({"area_m2", "m2", "one-sided area", all}, fields.area_m2);
  for (int axis = 0; axis < 3; ++axis) {
    table.add_view({std::string(1, "xyz"[axis]), "m", "centroid, " + axis_heading(fields.axes, axis), all & ~in_meshes},
                   fields.centroid_m[static_cast<std::size_t>(axis)]);
  }
  for (const std::vector<LightValues>& band : fields.light) {
    for (const LightValues& light : band) {
      Column column{light.name, light_units, meaning(light.column), all};
      if (light.column == LightColumn::total) column.outputs &= ~in_csv;
      if (light.column == LightColumn::absorbed) column.error_column = band.back().name;
      table.add_view(std::move(column), light.values);
    }
  }
  return table;
}

glm::dvec3 corner_m(const RadiationModel& model, std::size_t element, std::size_t corner) {
  return user_position_m(model.plot, glm::dvec3(model.canopy.corners[element][corner]) + model.canopy.origin_m);
}

bool corners_fit_float(const RadiationModel& model) {
  return model.plot.axes == Axes::south_up_west && model.canopy.origin_m == glm::dvec3(0.0);
}

}  // namespace sunfleck

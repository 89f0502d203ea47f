#include "files/results/tables/day_fields.h"

#include <algorithm>

namespace sunfleck {

std::vector<LightColumn> day_columns(const RadiationModel& model) {
  std::vector<LightColumn> columns = {LightColumn::direct_upper, LightColumn::direct_lower};
  if (model.sky) columns.insert(columns.end(), {LightColumn::sky_upper, LightColumn::sky_lower});
  columns.insert(columns.end(), {LightColumn::indirect_upper, LightColumn::indirect_lower, LightColumn::absorbed,
                                 LightColumn::absorbed_error});
  return columns;
}

std::vector<float> day_fields(const RadiationModel& model, const RadiationResult& result) {
  const std::vector<LightColumn> columns = day_columns(model);
  const ElementFields all = make_element_fields(model, result);
  std::vector<float> fields;
  fields.reserve(model.bands.size() * columns.size() * all.size());
  for (const std::vector<LightValues>& band : all.light) {
    for (const LightColumn column : columns) {
      const auto found = std::find_if(band.begin(), band.end(), [&](const LightValues& v) { return v.column == column; });
      if (found == band.end()) {
        fields.insert(fields.end(), all.size(), 0.0F);  // for a sky without light
      } else {
        for (const double value : found->values) fields.push_back(static_cast<float>(value));
      }
    }
  }
  return fields;
}

}  // namespace sunfleck

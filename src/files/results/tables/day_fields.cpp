#include "files/results/tables/day_fields.h"

#include "base/in_blocks.h"

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
  std::vector<float> fields(model.bands.size() * columns.size() * all.size());
  each_in_blocks(model.bands.size() * columns.size(), 1, [&](std::size_t k) {
    const std::vector<LightValues>& band = all.light[k / columns.size()];
    const LightColumn column = columns[k % columns.size()];
    const auto found = std::find_if(band.begin(), band.end(), [&](const LightValues& v) { return v.column == column; });
    if (found == band.end()) return;  // a sky without light
    const auto first = fields.begin() + static_cast<std::ptrdiff_t>(k * all.size());
    std::transform(found->values.begin(), found->values.end(), first, [](double value) { return static_cast<float>(value); });
  });
  return fields;
}

}  // namespace sunfleck

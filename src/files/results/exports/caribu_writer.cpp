#include "files/results/exports/caribu_writer.h"

#include "files/formats/mesh/caribu_label.h"
#include "files/results/exports/record_entries.h"
#include "physics/transport/model/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace sunfleck {
namespace {

std::size_t column_index(const std::vector<LightValues>& band, LightColumn column) {
  const auto found = std::find_if(band.begin(), band.end(), [&](const LightValues& v) { return v.column == column; });
  return static_cast<std::size_t>(found - band.begin());
}

}  // namespace

std::string caribu_csv(const ExportData& data) {
  const ElementFields& fields = data.fields;
  const Canopy& canopy = data.model.canopy;
  const std::vector<Role> roles = organ_roles(data.model);
  std::vector<std::string> labels;
  std::vector<std::size_t> next_number(canopy.organs.size());
  for (std::size_t e = 0; e < fields.size(); ++e) {
    const std::uint32_t number = canopy.organ_of[e];
    Organ organ = canopy.organs[number];
    organ.role = roles[number];
    const std::uint64_t label = canopy.labels.empty() ? no_label : canopy.labels[e];
    labels.push_back(label == no_label ? caribu_label(organ, next_number[number]++) : caribu_label_as_read(organ, label));
  }
  std::string text;
  for (const RecordEntry& entry : record_entries(data.record, data.model)) {
    text += fmt::format("# {}: {}\n", entry.key, entry.value);
  }
  text +=
      "# area: m2, one-sided; Eabs: W m-2 absorbed; Ei_sup, Ei_inf: W m-2 incident on the upper and the lower face; Ei: "
      "their sum\nband,index,label,area,Eabs,Ei,Ei_sup,Ei_inf\n";
  for (std::size_t b = 0; b < fields.light.size(); ++b) {
    const std::vector<LightValues>& band = fields.light[b];
    const auto values = [&](LightColumn column) -> const std::vector<double>& {
      return band[column_index(band, column)].values;
    };
    const std::vector<double>& absorbed = values(LightColumn::absorbed);
    const std::vector<double>& total = values(LightColumn::total);
    const std::vector<double>& direct_upper = values(LightColumn::direct_upper);
    const std::vector<double>& direct_lower = values(LightColumn::direct_lower);
    const std::vector<double>& indirect_upper = values(LightColumn::indirect_upper);
    const std::vector<double>& indirect_lower = values(LightColumn::indirect_lower);
    for (std::size_t e = 0; e < fields.size(); ++e) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", data.model.bands[b].name, e,
                     labels[e], fields.area_m2[e], absorbed[e], total[e], direct_upper[e] + indirect_upper[e],
                     direct_lower[e] + indirect_lower[e]);
    }
  }
  return text;
}

}  // namespace sunfleck

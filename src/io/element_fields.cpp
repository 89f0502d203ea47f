#include "io/element_fields.h"

#include "base/check.h"

#include <fmt/format.h>

#include <limits>
#include <map>

namespace sunfleck {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Collects the columns of one band, value by value.
class BandColumns {
 public:
  BandColumns(const RadiationModel& model, const RadiationResult& result, const ElementFields& fields, std::size_t band)
      : model_(model), result_(result), fields_(fields), band_(band) {}

  [[nodiscard]] double value(LightColumn column, std::size_t e) const {
    switch (column) {
      case LightColumn::direct_upper:
        return direct(result_.elements[e].upper, e);
      case LightColumn::direct_lower:
        return direct(result_.elements[e].lower, e);
      case LightColumn::sky_upper:
        return result_.side_sky_w_m2(2 * e, fields_.area_m2[e], band_);
      case LightColumn::sky_lower:
        return result_.side_sky_w_m2(2 * e + 1, fields_.area_m2[e], band_);
      case LightColumn::indirect_upper:
        return result_.side_indirect_w_m2(2 * e, fields_.area_m2[e], band_);
      case LightColumn::indirect_lower:
        return result_.side_indirect_w_m2(2 * e + 1, fields_.area_m2[e], band_);
      case LightColumn::total:
        return upper(e) + lower(e);
      case LightColumn::absorbed: {
        const SurfaceOptics& optics = model_.optics[model_.canopy.optics_of[e]];
        return upper(e) * optics.upper[band_].absorptance() + lower(e) * optics.lower[band_].absorptance();
      }
      case LightColumn::error:
        return result_.element_error.empty() ? none : result_.element_error[band_ * fields_.size() + e];
    }
    return none;
  }

 private:
  [[nodiscard]] double direct(std::uint64_t landings, std::size_t e) const {
    return result_.irradiance_w_m2(landings, fields_.area_m2[e], model_.bands[band_].direct_w_m2);
  }
  [[nodiscard]] double upper(std::size_t e) const {
    return value(LightColumn::direct_upper, e) + value(LightColumn::indirect_upper, e);
  }
  [[nodiscard]] double lower(std::size_t e) const {
    return value(LightColumn::direct_lower, e) + value(LightColumn::indirect_lower, e);
  }

  const RadiationModel& model_;
  const RadiationResult& result_;
  const ElementFields& fields_;
  std::size_t band_;
};

std::vector<LightColumn> columns_of(const RadiationResult& result) {
  std::vector<LightColumn> columns = {LightColumn::direct_upper, LightColumn::direct_lower};
  if (!result.side_sky.empty()) columns.insert(columns.end(), {LightColumn::sky_upper, LightColumn::sky_lower});
  columns.insert(columns.end(), {LightColumn::indirect_upper, LightColumn::indirect_lower, LightColumn::total,
                                 LightColumn::absorbed, LightColumn::error});
  return columns;
}

}  // namespace

const char* ending(LightColumn column) {
  switch (column) {
    case LightColumn::direct_upper:
      return "direct_upper";
    case LightColumn::direct_lower:
      return "direct_lower";
    case LightColumn::sky_upper:
      return "sky_upper";
    case LightColumn::sky_lower:
      return "sky_lower";
    case LightColumn::indirect_upper:
      return "indirect_upper";
    case LightColumn::indirect_lower:
      return "indirect_lower";
    case LightColumn::total:
      return "total";
    case LightColumn::absorbed:
      return "absorbed";
    case LightColumn::error:
      return "error";
  }
  return "";
}

const char* meaning(LightColumn column) {
  switch (column) {
    case LightColumn::direct_upper:
      return "irradiance of the upper face by the sun's beam";
    case LightColumn::direct_lower:
      return "irradiance of the lower face by the sun's beam";
    case LightColumn::sky_upper:
      return "irradiance of the upper face by sky light at its first hit, a part of indirect";
    case LightColumn::sky_lower:
      return "irradiance of the lower face by sky light at its first hit, a part of indirect";
    case LightColumn::indirect_upper:
      return "irradiance of the upper face by all light but the sun's beam at its first hit";
    case LightColumn::indirect_lower:
      return "irradiance of the lower face by all light but the sun's beam at its first hit";
    case LightColumn::total:
      return "irradiance of both faces together by all light";
    case LightColumn::absorbed:
      return "flux absorbed by both faces per one-sided area";
    case LightColumn::error:
      return "half-width of the confidence interval of absorbed";
  }
  return "";
}

ElementFields make_element_places(const Canopy& canopy) {
  ElementFields fields;
  std::map<std::string, std::int32_t> kind_of_name;
  std::vector<std::int32_t> kind_of_organ;  // [organ]
  for (const Organ& organ : canopy.organs) {
    const auto [found, is_new] = kind_of_name.emplace(organ.name, static_cast<std::int32_t>(fields.organ_names.size()));
    if (is_new) fields.organ_names.push_back(organ.name);
    kind_of_organ.push_back(found->second);
  }
  fields.optics_names = canopy.optics_names;
  for (std::size_t e = 0; e < canopy.size(); ++e) {
    const Organ& organ = canopy.organs[canopy.organ_of[e]];
    fields.plant.push_back(organ.plant);
    fields.rank.push_back(organ.rank);
    fields.organ.push_back(kind_of_organ[canopy.organ_of[e]]);
    fields.optics.push_back(canopy.optics_of[e]);
    const Triangle& corners = canopy.corners[e];
    fields.area_m2.push_back(area_m2(corners));
    const glm::dvec3 sum = glm::dvec3(corners[0]) + glm::dvec3(corners[1]) + glm::dvec3(corners[2]);
    for (int axis = 0; axis < 3; ++axis) {
      fields.centroid_m[static_cast<std::size_t>(axis)].push_back(sum[axis] / 3.0 + canopy.origin_m[axis]);
    }
  }
  return fields;
}

ElementFields make_element_fields(const RadiationModel& model, const RadiationResult& result) {
  EXPECT(result.elements.size(), ==, model.canopy.size());
  ElementFields fields = make_element_places(model.canopy);
  for (std::size_t b = 0; b < model.bands.size(); ++b) {
    const BandColumns band(model, result, fields, b);
    std::vector<LightValues> columns;
    for (const LightColumn column : columns_of(result)) {
      LightValues field{column, fmt::format("{}_{}", model.bands[b].name, ending(column)), {}};
      field.values.reserve(fields.size());
      for (std::size_t e = 0; e < fields.size(); ++e) field.values.push_back(band.value(column, e));
      columns.push_back(std::move(field));
    }
    fields.light.push_back(std::move(columns));
  }
  return fields;
}

glm::dvec3 corner_m(const Canopy& canopy, std::size_t element, std::size_t corner) {
  return glm::dvec3(canopy.corners[element][corner]) + canopy.origin_m;
}

bool corners_fit_float(const Canopy& canopy) {
  return canopy.origin_m == glm::dvec3(0.0);
}

}  // namespace sunfleck

#pragma once
// What a picture can show of a result: one number for every surface.

#include "pictures/picture.h"
#include "transport/counters.h"
#include "transport/model.h"
#include "transport/result.h"
#include "view/colour_scale.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// With its unit, as the heading of a legend: "Direct PAR irradiance, W m⁻²".
[[nodiscard]] std::string field_title(LightField field, const std::string& band);

// True if the scene has this light: a beam, a sky, anything that scatters or glows.
[[nodiscard]] bool has_field(const RadiationModel& model, LightField field);

// [surface number]: side 2 * element + face of every element, then the cells of the soil's map.
struct FieldValues {
  std::vector<double> w_m2;     // 0 without area
  std::vector<double> area_m2;  // one-sided
};

// Irradiance is incident on the side. Absorbed flux is that of both faces, per one-sided area, and stands on both; of the soil,
// what the cell absorbs. `layout` is the model's, `result` of the same model.
[[nodiscard]] FieldValues field_values(const RadiationModel& model, const CounterLayout& layout, const RadiationResult& result,
                                       std::size_t band, LightField field);

// Reflectance in red, green and blue, [surface number].
[[nodiscard]] std::vector<Colour> surface_reflectance(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck

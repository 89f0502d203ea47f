#pragma once
// What a picture can show of a result: one number per surface.

#include "physics/transport/model/counters.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"
#include "pictures/charts/picture.h"
#include "pictures/drawing/colour_scale.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// Returns the field's title with its unit, for the heading of a legend: "Direct PAR irradiance, W m⁻²".
[[nodiscard]] std::string field_title(LightField field, const std::string& band);

// Returns true if the scene has this light: a beam, a sky, or anything that scatters or emits light.
[[nodiscard]] bool has_field(const RadiationModel& model, LightField field);

// Arrays are [surface number]: side 2 * element + face of every element, then the cells of the soil's map.
struct FieldValues {
  std::vector<double> w_m2;     // 0 where the area is 0
  std::vector<double> area_m2;  // one-sided
};

// Returns the values of a field. Irradiance is that incident on the side. Absorbed flux is the sum of both faces per one-sided
// area, and is given for both; for the soil it is what the cell absorbs. `layout` is the model's and `result` is of the same
// model.
[[nodiscard]] FieldValues field_values(const RadiationModel& model, const CounterLayout& layout, const RadiationResult& result,
                                       std::size_t band, LightField field);

// Returns the reflectance in red, green and blue, [surface number].
[[nodiscard]] std::vector<Colour> surface_reflectance(const RadiationModel& model, const CounterLayout& layout);

}  // namespace sunfleck

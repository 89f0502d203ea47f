#pragma once
// The fields of a day: the light of every triangle at one step, as a day stores and exports it.

#include "files/results/tables/element_fields.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <vector>

namespace sunfleck {

// Returns the columns of triangles.csv that a day has; there are sky columns if the scene has a sky, lit or not.
[[nodiscard]] std::vector<LightColumn> day_columns(const RadiationModel& model);

// Returns the values of those columns, [(band * columns + column) * elements + element], W m-2.
[[nodiscard]] std::vector<float> day_fields(const RadiationModel& model, const RadiationResult& result);

}  // namespace sunfleck

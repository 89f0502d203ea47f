#pragma once
// Names the figure that a bound limits.

#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <string>

namespace sunfleck {

// Returns the name of the figure, e.g. "beam on vegetation", "PAR absorbed by soil", "NIR absorbed by leaf 7 of plant 3",
// "PAR at sensor pole".
[[nodiscard]] std::string figure_name(const JudgedFigure& figure, const RadiationModel& model);

}  // namespace sunfleck

#pragma once
// The figure that a bound judges, in words.

#include "transport/model.h"
#include "transport/result.h"

#include <string>

namespace sunfleck {

// Returns what the figure is, e.g. "beam on vegetation", "PAR absorbed by soil", "NIR absorbed by leaf 7 of plant 3".
[[nodiscard]] std::string figure_name(const JudgedFigure& figure, const RadiationModel& model);

}  // namespace sunfleck

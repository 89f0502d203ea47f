#pragma once
// Where a camera can stand in a canopy.

#include "transport/model.h"

#include <glm/vec3.hpp>

namespace sunfleck {

// The place over the plot, at that height, that is nearest to the plot's middle and 10 cm clear of every element's corners and
// centroid; where there is none, the middle. Scene's axes.
[[nodiscard]] glm::dvec3 open_spot(const RadiationModel& model, double height_m);

}  // namespace sunfleck

#pragma once
// Finds room for a camera in a canopy.

#include "physics/transport/model/model.h"

#include <glm/vec3.hpp>

namespace sunfleck {

// Returns the point over the plot at that height that is nearest to the middle of the plot and at least 10 cm away from every
// element's corners and centroid; the middle if there is none. In the scene's axes.
[[nodiscard]] glm::dvec3 open_spot(const RadiationModel& model, double height_m);

}  // namespace sunfleck

#include "physics/transport/model/lights.h"

#include <algorithm>

namespace sunfleck {

bool any_beam(Lights lights) {
  return std::any_of(lights.begin(), lights.end(), [](const RadiationModel& light) { return light.has_beam(); });
}

bool any_sky(Lights lights) {
  return std::any_of(lights.begin(), lights.end(), [](const RadiationModel& light) { return light.has_sky(); });
}

}  // namespace sunfleck

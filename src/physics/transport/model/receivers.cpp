#include "physics/transport/model/receivers.h"

#include <fmt/format.h>

#include <cmath>

namespace sunfleck {

std::string plane_stem(double height_m) {
  const double millimetres = std::round(1000.0 * height_m);
  return fmt::format("plane_{:.3f}", millimetres == 0.0 ? 0.0 : millimetres / 1000.0);
}

}  // namespace sunfleck

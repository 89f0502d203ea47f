#include "simulate/requests.h"

namespace sunfleck {

std::string StandFiles::first_given() const {
  if (!optics.empty()) return "--optics";
  if (!light.empty()) return "--light";
  if (!domain.empty()) return "--domain";
  return scale ? "--scale" : "";
}

}  // namespace sunfleck

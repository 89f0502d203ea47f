#include "base/version.h"

#include "version_numbers.h"

namespace sunfleck {

std::string version() {
  return SUNFLECK_VERSION;
}

std::string commit() {
  return SUNFLECK_COMMIT;
}

}  // namespace sunfleck

// Stands in for the window in a program that is built without it (SUNFLECK_VIEWER=OFF).

#include "base/error.h"
#include "viewer/view.h"

namespace sunfleck {

int view(const ViewOptions&) {
  throw_input("view", "this program was built without its window", "use render, or build it with -DSUNFLECK_VIEWER=ON");
}

}  // namespace sunfleck

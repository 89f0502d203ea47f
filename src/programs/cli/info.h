#pragma once
// The command `info`.

#include "programs/cli/options.h"

namespace sunfleck {

// Describes the meshes, if any are given; otherwise prints the devices and, if a scene is given, its figures and the memory
// that a run of it needs. Returns the exit status. Throws Error.
[[nodiscard]] int show_info(const InfoOptions& options);

}  // namespace sunfleck

#pragma once
// The command `new`.

#include "programs/cli/options.h"

namespace sunfleck {

// Writes a scene for the meshes to a file or to standard output. Returns the exit status. Throws Error (input) for a file that
// is no mesh, and for an output that exists or does not end in .toml.
[[nodiscard]] int write_new_scene(const NewOptions& options);

}  // namespace sunfleck

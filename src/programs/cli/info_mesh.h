#pragma once
// The command `info` for meshes.

#include "programs/cli/options.h"

namespace sunfleck {

// Prints what each mesh holds and in which unit and axes it seems to be, as text or JSON. Returns the exit status. Throws Error
// (input) for a file that is no mesh, and for one that read_mesh refuses.
[[nodiscard]] int show_meshes(const InfoOptions& options);

}  // namespace sunfleck

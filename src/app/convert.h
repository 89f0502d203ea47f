#pragma once
// The command `convert`.

#include "app/options.h"

namespace sunfleck {

// A mesh with CARIBU's files becomes a scene file; a mesh, or the whole canopy of a scene, another kind of mesh. A scene runs
// as it stands: files that do not lie in its folder or below are copied beside it. No input is written over, and no other file
// beside OUT. Returns the exit status. Throws Error.
[[nodiscard]] int convert(const ConvertOptions& options);

}  // namespace sunfleck

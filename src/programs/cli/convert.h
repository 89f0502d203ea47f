#pragma once
// The command `convert`.

#include "programs/cli/options.h"

namespace sunfleck {

// Converts a mesh with CARIBU's files to a scene file, or a mesh or the whole canopy of a scene to another mesh format. The new
// scene file is ready to run: files outside its folder are copied next to it. No input is overwritten, nor any other file next
// to OUT. Returns the exit status. Throws Error.
[[nodiscard]] int convert(const ConvertOptions& options);

}  // namespace sunfleck

#pragma once
// The command `view`: shows a scene in a window.

#include "programs/cli/options.h"

namespace sunfleck {

// Runs until the window is closed. Returns the exit status. Throws Error (input) for a broken scene, Error (device) without a
// display.
[[nodiscard]] int view(const ViewOptions& options);

}  // namespace sunfleck

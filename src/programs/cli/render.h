#pragma once
// The command `render` draws one picture.

#include "programs/cli/options.h"

namespace sunfleck {

// Returns the exit status, as `run` does. Draws a finished run's folder from its stored data; simulates a scene first.
[[nodiscard]] int render(const RenderOptions& options);

}  // namespace sunfleck

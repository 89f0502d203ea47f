#pragma once
// The command `render`: one picture.

#include "app/options.h"

namespace sunfleck {

// Exit status as of `run`. A finished run's folder is drawn from what is stored there; a scene is simulated first.
[[nodiscard]] int render(const RenderOptions& options);

}  // namespace sunfleck

#pragma once
// The command `validate`.

#include "programs/cli/options.h"

namespace sunfleck {

[[nodiscard]] int validate(const ValidateOptions& options);

}  // namespace sunfleck

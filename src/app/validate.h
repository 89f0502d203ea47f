#pragma once
// The command `validate`.

#include "app/options.h"

namespace sunfleck {

[[nodiscard]] int validate(const ValidateOptions& options);

}  // namespace sunfleck

#pragma once
// The command `tradeoff`.

#include "programs/cli/options.h"

namespace sunfleck {

[[nodiscard]] int tradeoff(const TradeoffOptions& options);

}  // namespace sunfleck

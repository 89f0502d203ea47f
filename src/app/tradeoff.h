#pragma once
// The command `tradeoff`.

#include "app/options.h"

namespace sunfleck {

[[nodiscard]] int tradeoff(const TradeoffOptions& options);

}  // namespace sunfleck

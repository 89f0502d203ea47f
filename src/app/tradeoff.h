#pragma once
// sunfleck tradeoff.

#include "app/options.h"

namespace sunfleck {

[[nodiscard]] int tradeoff(const TradeoffOptions& options);

}  // namespace sunfleck

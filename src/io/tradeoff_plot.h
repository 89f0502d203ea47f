#pragma once
// tradeoff.png: error against time, a panel for each ladder.

#include "io/tradeoff_table.h"

#include <string>

namespace sunfleck {

// The gnuplot script. Logarithmic axes; a curve a quantity through what its ladder measured, with the slope of the error over
// rays beside it; the recommended bound and the marked grid where there are such. Any report can be drawn.
[[nodiscard]] std::string tradeoff_plot(const TradeoffReport& report);

}  // namespace sunfleck

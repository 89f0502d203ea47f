#pragma once
// tradeoff.png: error against time, one panel per ladder.

#include "io/tradeoff_table.h"

#include <string>

namespace sunfleck {

// Returns the gnuplot script. The axes are logarithmic; each quantity has a curve through the measurements of the ladder,
// annotated with the slope of its error over rays. The recommended bound and the marked grid are shown if present. Any report
// can be drawn.
[[nodiscard]] std::string tradeoff_plot(const TradeoffReport& report);

}  // namespace sunfleck

#pragma once
// The command `day`.

#include "programs/cli/options.h"

namespace sunfleck {

// Simulates the steps of one or several days with one tree on one device. Returns 0 if each step is done within its bounds, 1
// if --max-seconds stopped the day or --max-rays a step, and 130 if interrupted. In every case the finished steps are kept and
// the tables written; the tables are always made from the stored steps.
[[nodiscard]] int run_day(const DayOptions& options);

}  // namespace sunfleck

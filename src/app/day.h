#pragma once
// The command `day`.

#include "app/options.h"

namespace sunfleck {

// Simulates the steps of a day or several with one tree on one device. Returns 0: done, each step within its bounds; 1: stopped
// by --max-seconds, or a step by --max-rays; 130: interrupted. In every case the finished steps are kept and the tables written;
// the tables are always made from the stored steps.
[[nodiscard]] int run_day(const DayOptions& options);

}  // namespace sunfleck

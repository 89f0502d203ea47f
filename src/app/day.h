#pragma once
// The command `day`: one tree and one device for all steps of a day or several.

#include "app/options.h"

namespace sunfleck {

// 0: done, each step within its bounds; 1: stopped by --max-seconds, or a step by --max-rays; 130: interrupted. Finished steps
// are kept in every case, and the tables written.
//
// Step n, from 0, has the seed RandomStream(seed, n).word(). Its replicates begin as large as the last simulated step's would
// now be chosen (RadiationResult::next_work), which is stored with the step: a day that was stopped anywhere and goes on gives
// the same bytes as one that was not. The tables are always made from the stored steps.
[[nodiscard]] int run_day(const DayOptions& options);

}  // namespace sunfleck

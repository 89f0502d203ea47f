#pragma once
// The commands of the program; each returns the exit status.

#include "app/options.h"

namespace sunfleck {

// 0: done, the bound reached if there is one; 1: stopped short of it; 130: interrupted. Results are written in every case.
[[nodiscard]] int run(const RunOptions& options);

// Returns true in a rank other than 0 for commands that do not share their work: rank 0 works alone, the others have nothing to
// do.
[[nodiscard]] bool is_left_to_rank_0(const Command& command);

[[nodiscard]] int write_maize(const MaizeOptions& options);
[[nodiscard]] int show_info(const InfoOptions& options);

}  // namespace sunfleck

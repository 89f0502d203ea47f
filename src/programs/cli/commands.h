#pragma once
// The commands of the program. Each returns the exit status.

#include "programs/cli/options.h"

namespace sunfleck {

// Returns 0 if the run is done and has reached its bound, if any; 1 if it stopped short of the bound; 130 if it was
// interrupted. In every case the results are written.
[[nodiscard]] int run(const RunOptions& options);

// Returns true in a rank other than 0 for commands that do not share their work: rank 0 works alone.
[[nodiscard]] bool is_left_to_rank_0(const Command& command);

[[nodiscard]] int write_maize(const MaizeOptions& options);

}  // namespace sunfleck

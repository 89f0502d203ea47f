#pragma once
// All sums of a tally as plain numbers, in an order of its own; the first integer is the number of replicates.

#include <cstdint>
#include <vector>

namespace sunfleck {

struct TallySums {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

}  // namespace sunfleck

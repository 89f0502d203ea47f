#pragma once
// Loops that the threads of a run share.

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace sunfleck {

[[nodiscard]] constexpr std::size_t block_count(std::size_t count, std::size_t block_size) {
  return (count + block_size - 1) / block_size;
}

// Calls take(block, first, end) for each block of the numbers below `count`, `block_size` of them but in the last one, in any order and
// several at a time.
template <class Take>
void in_blocks(std::size_t count, std::size_t block_size, const Take& take) {
  const auto one = [&](std::size_t block) { take(block, block * block_size, std::min(count, (block + 1) * block_size)); };
  if (count <= block_size) {
    if (count > 0) one(0);
    return;
  }
  tbb::parallel_for(std::size_t{0}, block_count(count, block_size), one);
}

}  // namespace sunfleck

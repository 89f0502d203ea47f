#pragma once
// Loops that the threads of a run share.

#include "base/prefetch.h"
#include "base/rounding.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace sunfleck {

// Calls take(block, first, end) for each block of the numbers below `count`, `block_size` of them but in the last one, in any
// order and several at a time.
template <class Take>
void in_blocks(std::size_t count, std::size_t block_size, const Take& take) {
  const auto one = [&](std::size_t block) { take(block, block * block_size, std::min(count, (block + 1) * block_size)); };
  if (count <= block_size) {
    if (count > 0) one(0);
    return;
  }
  tbb::parallel_for(std::size_t{0}, block_count(count, block_size), one);
}

// Calls take(k) for each number k below `count`, several at a time. The thread does nothing else meanwhile, so that it may hold
// a lock.
template <class Take>
void each_at_once(std::size_t count, const Take& take) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, take); });
}

// Calls take(k) for each number k below `count`, block by block; before it come(k), some numbers ahead, so that memory can be
// asked for.
template <class Come, class Take>
void each_in_blocks(std::size_t count, std::size_t block_size, const Come& come, const Take& take) {
  in_blocks(count, block_size, [&](std::size_t, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      if (k + prefetch_ahead < end) come(k + prefetch_ahead);
      take(k);
    }
  });
}

// Does the same without looking ahead.
template <class Take>
void each_in_blocks(std::size_t count, std::size_t block_size, const Take& take) {
  each_in_blocks(
      count, block_size, [](std::size_t) {}, take);
}

}  // namespace sunfleck

#include "physics/transport/indirect/counted_thread.h"

#include "base/threads.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cstddef>
#include <deque>

namespace sunfleck {
namespace {

std::size_t allowed() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

TEST(CountedThread, LeavesTbbTheThreadsThatAreNotAtWork) {
  const CpuThreads limit(4);
  std::deque<CountedThread> threads;
  for (const std::size_t left : {4, 3, 2, 1, 1}) {
    threads.emplace_back();
    EXPECT_EQ(allowed(), left);
  }
  for (const std::size_t left : {1, 2, 3, 4, 4}) {
    threads.pop_front();  // they end in any order
    EXPECT_EQ(allowed(), left);
  }
}

TEST(CountedThread, CountsAmongTheThreadsOfEachRunAnew) {
  for (const int threads : {2, 5}) {
    const CpuThreads limit(threads);
    const CountedThread one;
    const CountedThread other;
    EXPECT_EQ(allowed(), static_cast<std::size_t>(threads) - 1);
  }
}

}  // namespace
}  // namespace sunfleck

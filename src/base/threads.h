#pragma once
// The threads of a run.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <cstddef>

namespace sunfleck {

// Returns how many threads may share a loop.
[[nodiscard]] inline std::size_t threads_allowed() {
  return oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
}

// Returns how many threads the CPU path has if `threads` are asked for; 0 asks for all cores.
[[nodiscard]] inline int cpu_thread_count(int threads) {
  return threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
}

// Sets the number of threads of the CPU path for the lifetime of the object; 0: all cores.
class CpuThreads {
 public:
  explicit CpuThreads(int threads)
      : limit_(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(cpu_thread_count(threads))) {}
  CpuThreads(const CpuThreads&) = delete;
  CpuThreads& operator=(const CpuThreads&) = delete;

 private:
  oneapi::tbb::global_control limit_;
};

}  // namespace sunfleck

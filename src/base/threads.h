#pragma once
// The threads of a run.

#include <oneapi/tbb/global_control.h>

#include <cstddef>

namespace sunfleck {

// Returns how many threads may share a loop.
[[nodiscard]] inline std::size_t threads_allowed() {
  return oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
}

}  // namespace sunfleck

#pragma once
// What this program uses of oneTBB, on std::thread: for the thread sanitizer, which knows nothing of what a library without its
// instrumentation does to order memory. Each call starts its own threads and joins them; in between nothing orders their work,
// so that every access that only oneTBB's scheduling would have made safe is reported.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <class Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  [[nodiscard]] Value begin() const { return begin_; }
  [[nodiscard]] Value end() const { return end_; }
  [[nodiscard]] std::size_t grainsize() const { return grain_; }

 private:
  Value begin_, end_;
  std::size_t grain_;
};

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads) : before_(most().exchange(threads)) {}
  ~global_control() { most() = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  static std::size_t active_value(parameter) { return most(); }

 private:
  static std::atomic<std::size_t>& most() {
    static std::atomic<std::size_t> threads{std::numeric_limits<std::size_t>::max()};
    return threads;
  }
  std::size_t before_;
};

namespace info {
inline int default_concurrency() {
  return 4;  // more than there may be cores
}
}  // namespace info

template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  constexpr auto order = std::memory_order_relaxed;  // shares out pieces, and orders nothing else
  std::atomic<Value> next{range.begin()};
  std::exception_ptr error;
  std::mutex of_error;
  const auto work = [&] {
    try {
      const auto grain = static_cast<Value>(range.grainsize());
      for (Value begin = next.fetch_add(grain, order); begin < range.end(); begin = next.fetch_add(grain, order)) {
        body(blocked_range<Value>(begin, begin + std::min<Value>(grain, range.end() - begin), range.grainsize()));
      }
    } catch (...) {
      const std::lock_guard lock(of_error);
      error = std::current_exception();
    }
  };
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  std::vector<std::thread> threads(std::min<std::size_t>(allowed, info::default_concurrency()) - 1);
  for (std::thread& thread : threads) thread = std::thread(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}

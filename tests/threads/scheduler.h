#pragma once
// Implements the parts of oneTBB that this program uses, on std::thread, for the thread sanitizer: the sanitizer does not see
// how a library without its instrumentation orders memory. Each call starts its own threads and joins them; in between nothing
// orders their work, so that every access that only oneTBB's scheduling would have made safe is reported.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace tbb {

template <class Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  [[nodiscard]] Value begin() const { return begin_; }
  [[nodiscard]] Value end() const { return end_; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  [[nodiscard]] std::size_t grainsize() const { return grain_; }

 private:
  Value begin_, end_;
  std::size_t grain_;
};

// The least of all limits holds; they may end in any order.
class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads) {
    const std::lock_guard lock(all().mutex);
    own_ = all().limits.insert(threads);
  }
  ~global_control() {
    const std::lock_guard lock(all().mutex);
    all().limits.erase(own_);
  }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  static std::size_t active_value(parameter) {
    const std::lock_guard lock(all().mutex);
    return all().limits.empty() ? std::numeric_limits<std::size_t>::max() : *all().limits.begin();
  }

 private:
  struct All {
    std::mutex mutex;
    std::multiset<std::size_t> limits;
  };
  static All& all() {
    static All of_process;
    return of_process;
  }
  std::multiset<std::size_t>::iterator own_;
};

namespace info {
inline int default_concurrency() {
  return 4;  // possibly more than there are cores
}
}  // namespace info

// Deals each thread's pieces beforehand, in turn: if each piece went to the first free thread, a short loop would be over
// before the second thread has started, and nothing would be tested.
template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  const std::size_t workers = std::min<std::size_t>(allowed, info::default_concurrency());
  std::exception_ptr error;
  std::mutex of_error;
  const auto work = [&](std::size_t worker) {
    try {
      const auto grain = static_cast<Value>(range.grainsize());
      std::size_t piece = 0;
      for (Value begin = range.begin(), end; begin < range.end(); begin = end, ++piece) {
        end = begin + std::min<Value>(grain, range.end() - begin);
        if (piece % workers == worker) body(blocked_range<Value>(begin, end, range.grainsize()));
      }
    } catch (...) {
      const std::lock_guard lock(of_error);
      error = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t worker = 1; worker < workers; ++worker) threads.emplace_back(work, worker);
  work(0);
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

// Calls body(k) for all k in [first, end).
template <class Index, class Body>
void parallel_for(Index first, Index end, const Body& body) {
  if (!(first < end)) return;
  const auto grain = std::max<std::size_t>(1, static_cast<std::size_t>(end - first) / 64);
  parallel_for(blocked_range<Index>(first, end, grain), [&](const blocked_range<Index>& range) {
    for (Index k = range.begin(); k < range.end(); ++k) body(k);
  });
}

// Calls all functions, each in a thread of its own but for the first.
template <class First, class... Others>
void parallel_invoke(const First& first, const Others&... others) {
  std::exception_ptr error;
  std::mutex of_error;
  const auto call = [&](const auto& function) {
    try {
      function();
    } catch (...) {
      const std::lock_guard lock(of_error);
      error = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  (threads.emplace_back([&] { call(others); }), ...);
  call(first);
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

// Its threads would touch nothing but what is sorted.
template <class Iterator, class Compare>
void parallel_sort(Iterator begin, Iterator end, const Compare& compare) {
  std::sort(begin, end, compare);
}

namespace this_task_arena {
// A thread here never takes on other work while it waits.
template <class Function>
auto isolate(const Function& function) {
  return function();
}
}  // namespace this_task_arena

}  // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}

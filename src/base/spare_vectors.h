#pragma once
// Long vectors that are made, read and dropped again and again, such as the sums of each replicate: their memory serves for the
// next ones, which the system would have to fetch and clear.

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace sunfleck {

// Several threads may use it.
template <class T>
class SpareVectors {
 public:
  // Returns a vector of `count` zeros.
  [[nodiscard]] std::vector<T> zeros(std::size_t count) {
    std::vector<T> values = take(count);
    values.assign(count, T{});
    return values;
  }

  // Keeps a vector for those who ask for as many values, but no more vectors of that size than were lent.
  void give_back(std::vector<T> values) {
    const std::lock_guard lock(mutex_);
    std::size_t& lent = lent_[values.size()];
    if (lent == 0) return;
    --lent;
    spare_.push_back(std::move(values));
  }

  // Returns the memory of the vectors that are kept, in bytes.
  [[nodiscard]] std::size_t bytes() {
    const std::lock_guard lock(mutex_);
    std::size_t bytes = 0;
    for (const std::vector<T>& values : spare_) bytes += values.capacity() * sizeof(T);
    return bytes;
  }

  void free() {
    const std::lock_guard lock(mutex_);
    spare_ = {};
  }

 private:
  [[nodiscard]] std::vector<T> take(std::size_t count) {
    const std::lock_guard lock(mutex_);
    ++lent_[count];
    const auto found = std::find_if(spare_.begin(), spare_.end(), [&](const auto& values) { return values.size() == count; });
    if (found == spare_.end()) return {};
    std::swap(*found, spare_.back());
    std::vector<T> values = std::move(spare_.back());
    spare_.pop_back();
    return values;
  }

  std::mutex mutex_;
  std::map<std::size_t, std::size_t> lent_;  // [size]
  std::vector<std::vector<T>> spare_;
};

}  // namespace sunfleck

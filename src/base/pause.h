#pragma once
// Pauses between polls.

#include <algorithm>
#include <chrono>
#include <thread>

namespace sunfleck {

// Pauses that are short at first, so that a quick answer is not delayed, and then grow until polling costs next to nothing.
class Pause {
 public:
  void take() {
    std::this_thread::sleep_for(next_);
    next_ = std::min(longest, next_ + next_ / 4);
  }
  void restart() { next_ = shortest; }

 private:
  using Duration = std::chrono::microseconds;
  static constexpr Duration shortest{20}, longest{500};
  Duration next_ = shortest;
};

}  // namespace sunfleck

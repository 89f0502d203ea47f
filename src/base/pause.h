#pragma once
// Waiting for something that has to be asked for.

#include <algorithm>
#include <chrono>
#include <thread>

namespace sunfleck {

// Short rests at first, so that what comes soon is not kept waiting, then longer ones, which cost next to nothing.
class Pause {
 public:
  void take() {
    std::this_thread::sleep_for(next_);
    next_ = std::min(longest, next_ + next_ / 4);
  }
  void begin_anew() { next_ = shortest; }

 private:
  using Duration = std::chrono::microseconds;
  static constexpr Duration shortest{20}, longest{500};
  Duration next_ = shortest;
};

}  // namespace sunfleck

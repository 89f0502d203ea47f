#pragma once

#include <chrono>

namespace sunfleck {

// Starts when constructed.
class Stopwatch {
 public:
  // Returns the seconds since the start or the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

  // Returns the seconds since the start or the last lap, and continues to measure.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace sunfleck

#pragma once
// Limits the rays per dispatch, so that a device shared with a window responds soon.

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace sunfleck {

// Adapts to the speed of a device: rays() is the number that takes about the requested time, judging by earlier dispatches.
// Without a requested time it is always the maximum. Several threads may ask and record at the same time.
class DispatchBudget {
 public:
  DispatchBudget(std::uint32_t most, double seconds)
      : most_(most), seconds_(seconds), rays_(seconds > 0.0 ? std::min(most, least) : most) {}

  [[nodiscard]] std::uint32_t rays() const { return rays_; }

  // Records how long `rays` rays took.
  void record_duration(std::uint32_t rays, double seconds) {
    if (seconds_ <= 0.0 || rays < least) return;
    const double fit = static_cast<double>(rays) * seconds_ / std::max(seconds, 1e-6);
    // At most doubles the number, since a single measurement may be wrong.
    const double next = std::min({fit, 2.0 * static_cast<double>(rays_), static_cast<double>(most_)});
    rays_ = std::max(std::min(most_, least), static_cast<std::uint32_t>(next));
  }

 private:
  static constexpr std::uint32_t least = 4096;
  std::uint32_t most_;
  double seconds_;
  std::atomic<std::uint32_t> rays_;
};

}  // namespace sunfleck

#include "physics/transport/solve/run_limits.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace sunfleck {

RunLimits::RunLimits(const SolveSettings& settings, const Monitor& monitor) : settings_(settings), monitor_(monitor) {}

std::optional<double> RunLimits::seconds_left() const {
  if (!settings_.max_seconds) return std::nullopt;
  return std::max(0.0, *settings_.max_seconds - seconds());
}

bool RunLimits::must_stop() {
  const std::lock_guard lock(mutex_);
  if (monitor_.is_interrupted()) {
    reason_ = StopReason::interrupted;
    return true;
  }
  if (settings_.max_seconds && seconds() >= *settings_.max_seconds) {
    reason_ = StopReason::time_spent;
    return true;
  }
  return false;
}

bool RunLimits::lacks_rays(std::uint64_t traced, std::uint64_t next) {
  if (!settings_.max_rays || traced + next <= *settings_.max_rays) return false;
  reason_ = StopReason::rays_spent;
  return true;
}

double RunLimits::affordable_replicates(double seconds_each, std::uint64_t traced, std::size_t replicates) const {
  double most = std::numeric_limits<double>::infinity();
  if (const auto left = seconds_left()) most = *left / std::max(seconds_each, 1e-9);
  if (settings_.max_rays && replicates > 0) {
    const auto rays = static_cast<double>(traced);
    const double each = std::max(1.0, rays / static_cast<double>(replicates));
    most = std::min(most, std::floor(std::max(0.0, static_cast<double>(*settings_.max_rays) - rays) / each));
  }
  return most;
}

double RunLimits::clock_s() const {
  if (monitor_.clock_s) return monitor_.clock_s();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace sunfleck

#pragma once
// What may end a run before its work is done: an interruption, and limits on its time and on its rays.

#include "physics/transport/solve/solve.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

namespace sunfleck {

class RunLimits {
 public:
  // The run begins now. Both arguments must outlive the object.
  RunLimits(const SolveSettings& settings, const Monitor& monitor);

  // Returns the time since the run began, and what is left of max_seconds: at least 0, empty without that limit.
  [[nodiscard]] double seconds() const { return clock_s() - start_s_; }
  [[nodiscard]] std::optional<double> seconds_left() const;

  // Returns true once the run has to end, and keeps the reason. Any thread may call it.
  [[nodiscard]] bool must_stop();

  // Returns true if the `next` rays and packets would take those traced beyond max_rays, and keeps the reason.
  [[nodiscard]] bool lacks_rays(std::uint64_t traced, std::uint64_t next);

  // Returns how many more replicates the limits allow if each takes so long, and as many rays as those made so far.
  [[nodiscard]] double affordable_replicates(double seconds_each, std::uint64_t traced, std::size_t replicates) const;

  // Returns why the run has to end.
  [[nodiscard]] StopReason reason() const { return reason_; }

 private:
  [[nodiscard]] double clock_s() const;

  const SolveSettings& settings_;
  const Monitor& monitor_;
  double start_s_ = clock_s();
  std::mutex mutex_;
  StopReason reason_ = StopReason::interrupted;
};

}  // namespace sunfleck

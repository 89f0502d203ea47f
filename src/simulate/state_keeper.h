#pragma once
// Writes the states of simulations to their stores while they work.

#include "files/results/stores/run_store.h"
#include "physics/transport/solve/solve.h"

#include <chrono>

namespace sunfleck {

// Writes the state after a finished replicate, once fifty times the duration of the last write has passed (at first that of an
// estimate) and at least half a second: this costs about 2 % of the time. Writes it once more at the end of a stopped simulation.
class StateKeeper {
 public:
  // `command` is the one that is resumed, "run" or "day".
  explicit StateKeeper(const char* command);

  // Makes the monitor hand over states of a simulation in these lights, and writes them to the store; a disk that rejects them is
  // reported once. It remembers from earlier simulations how long writing takes. The keeper must outlive the monitor's use.
  void attend(Monitor& monitor, const RunStore& store, Lights lights);

  [[nodiscard]] bool has_written() const { return written_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_due();
  void keep(const RunStore& store, const SolveStateView& state);

  const char* command_;
  bool written_ = false, failed_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
  Clock::duration pause_;
};

}  // namespace sunfleck

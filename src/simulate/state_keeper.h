#pragma once
// Writes the state of a simulation to its store while the simulation works.

#include "files/results/stores/run_store.h"
#include "physics/transport/solve/solve.h"

#include <chrono>
#include <utility>

namespace sunfleck {

// Writes the state after a finished replicate, once fifty times the duration of the last write has passed and at least half a
// second: this costs at most 2 % of the time. Writes it once more at the end of a stopped simulation.
class StateKeeper {
 public:
  // `command` is the one that is resumed, "run" or "day".
  StateKeeper(RunStore store, const char* command);

  // Makes it keep the states of another simulation; how long writing takes is remembered.
  void turn_to(RunStore store) { store_ = std::move(store); }

  // Makes the monitor hand over states, and writes them; a disk that rejects them is reported once. The keeper must outlive the
  // monitor's use.
  void attend(Monitor& monitor);

  [[nodiscard]] const RunStore& store() const { return store_; }
  [[nodiscard]] bool has_written() const { return written_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_due();
  void keep(const SolveStateView& state);

  RunStore store_;
  const char* command_;
  bool written_ = false, failed_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
  Clock::duration pause_;
};

}  // namespace sunfleck

#pragma once
// Keeps the state of a run in its folder while it works, so that `run --resume` can resume it.

#include "files/results/stores/run_store.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/solve/solve.h"

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// Writes the state after a finished replicate, once fifty times the duration of the last write has passed and at least half a
// second: this costs at most 2 % of the time. Writes it once more at the end of a stopped run.
class Checkpoint {
 public:
  // `exports` are the exports requested for the run.
  Checkpoint(std::filesystem::path folder, std::vector<std::string> exports, const Scene& scene, const SolveSettings& settings);

  enum class Found { nothing, begun, finished };
  // Returns what an earlier run left in the folder. Throws Error (input) if its settings were different, if its state is
  // damaged, or if it is finished but lacks a file that `exports` requires.
  [[nodiscard]] Found find(const RadiationModel& model);

  // Returns the state of the unfinished run, or null if there is none.
  [[nodiscard]] const SolveState* state() const { return found_ ? &*found_ : nullptr; }

  // Returns a line for the user that says from where the run resumes.
  [[nodiscard]] std::string resume_line() const;

  // Makes the monitor hand over states, and writes them; a disk that rejects them is reported once.
  void attend(Monitor& monitor);

  // Returns whether a state of this run is in the folder.
  [[nodiscard]] bool holds_state() const { return found_.has_value() || written_; }

  // Removes the state, once all results are written. Throws Error (failure).
  void finish() const;

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_finished() const;
  [[nodiscard]] bool is_due();
  void keep(const SolveStateView& state);

  std::filesystem::path folder_;
  std::vector<std::string> exports_;
  ElementErrors element_errors_;
  nlohmann::ordered_json settings_;
  RunStore store_;
  std::optional<SolveState> found_;
  bool written_ = false, failed_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
  Clock::duration pause_;
};

}  // namespace sunfleck

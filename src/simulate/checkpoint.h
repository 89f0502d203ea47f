#pragma once
// Keeps the state of a run in its folder while it works, so that `run --resume` can resume it.

#include "files/results/stores/run_store.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/solve/solve.h"
#include "simulate/state_keeper.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

class Checkpoint {
 public:
  // `exports` are the exports requested for the run.
  Checkpoint(std::filesystem::path folder, std::vector<std::string> exports, const Scene& scene, const SolveSettings& settings);

  enum class Found { nothing, begun, finished };
  // Returns what an earlier run left in the folder. Throws Error (input) if its settings were different, if its state is
  // damaged, or if it is finished but lacks a file that `exports` requires.
  [[nodiscard]] Found find(const RadiationModel& model, const SolveSettings& settings);

  // Returns the state of the unfinished run, or null if there is none.
  [[nodiscard]] const SolveState* state() const { return found_ ? &*found_ : nullptr; }

  // Returns a line for the user that says from where the run resumes.
  [[nodiscard]] std::string resume_line() const;

  // Has the state written while the monitor watches the run of the model.
  void attend(Monitor& monitor, const RadiationModel& model) { keeper_.attend(monitor, store_, {&model, 1}); }

  // Returns whether a state of this run is in the folder.
  [[nodiscard]] bool holds_state() const { return found_.has_value() || keeper_.has_written(); }

  // Removes the state, once all results are written. Throws Error (failure).
  void finish() const;

 private:
  [[nodiscard]] bool is_finished() const;

  std::filesystem::path folder_;
  std::vector<std::string> exports_;
  nlohmann::ordered_json settings_;
  RunStore store_;
  StateKeeper keeper_{"run"};
  std::optional<SolveState> found_;
};

}  // namespace sunfleck

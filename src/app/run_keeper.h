#pragma once
// What `run --resume` goes on from: keeps a run's state in its folder while it works.

#include "app/options.h"
#include "io/run_store.h"
#include "io/scene_reader.h"
#include "transport/solve.h"

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// The state is written after a finished replicate once fifty times as long has passed as writing it took the last time, and
// at least half a second: keeping it costs at most 2 % of the time. And once more at the end of a run that is stopped.
class RunKeeper {
 public:
  RunKeeper(std::filesystem::path folder, const RunOptions& options, const Scene& scene, const SolveSettings& settings);

  enum class Found { nothing, begun, finished };
  // What an earlier run left in the folder. Throws Error (input) if its settings were others, its state is damaged, or it is
  // finished without a file that `exports` asks for.
  [[nodiscard]] Found find(const RadiationModel& model, const CounterLayout& layout);

  // Of the run that was begun.
  [[nodiscard]] const SolveState* state() const { return found_ ? &*found_ : nullptr; }

  // Where the run goes on, for the user.
  [[nodiscard]] std::string resume_line() const;

  // Has the state kept; a disk that takes none is said once.
  void attend(Monitor& monitor);

  // A state of this run is in the folder.
  [[nodiscard]] bool holds_state() const { return found_.has_value() || written_; }

  void finish() const;  // All is written: the state goes. Throws Error (failure)

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_finished() const;
  [[nodiscard]] bool is_due();
  void keep(const SolveState& state);

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

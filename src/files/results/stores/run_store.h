#pragma once
// Stores the state of an unfinished simulation, from which --resume resumes: of a run in run_state.bin of the result folder, of a
// day's block of steps in steps/block_state.bin (step_store.h). The file format is that of base/sealed_file.h, with long
// arrays as base/packed_array.h describes.

#include "physics/transport/solve/solve_state.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace sunfleck {

inline constexpr const char* run_state_file = "run_state.bin";

class RunStore {
 public:
  // `settings` is a JSON object of plain values with everything that determines the bytes of the results.
  RunStore(const std::filesystem::path& result_folder, const nlohmann::ordered_json& settings,
           const std::filesystem::path& file = run_state_file);

  // Returns whether an earlier run left a file.
  [[nodiscard]] bool exists() const;

  // Returns the state left by an earlier run, or nothing. Throws Error (input) if the settings differ, naming the first
  // difference, or if the file is damaged.
  [[nodiscard]] std::optional<SolveState> read(const StateShape& shape) const;

  // Writes the file aside and renames it. Throws Error (failure).
  void write(const SolveStateView& state) const;

  void remove() const;  // throws Error (failure)

 private:
  std::filesystem::path folder_, file_;
  std::string settings_;  // JSON
};

}  // namespace sunfleck

#pragma once
// The state of a run that is not finished, on disk: run_state.bin of the result folder, from which `run --resume` goes on. As
// in io/sealed_file.h; its arrays are deflated (zlib).

#include "transport/solve_state.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace sunfleck {

inline constexpr const char* run_state_file = "run_state.bin";

class RunStore {
 public:
  // `settings`: a JSON object of plain values, all that the bytes of the run's tables depend on.
  RunStore(const std::filesystem::path& result_folder, const nlohmann::ordered_json& settings);

  // What a run left; empty if there is none. `blank` tells its size. Throws Error (input) if its settings were others, naming
  // the first difference, or if it is damaged.
  [[nodiscard]] std::optional<SolveState> read(const SolveState& blank) const;

  // Written aside and renamed. Throws Error (failure).
  void write(const SolveState& state) const;

  void remove() const;  // Throws Error (failure)

 private:
  std::filesystem::path folder_, file_;
  std::string settings_;  // JSON
};

}  // namespace sunfleck

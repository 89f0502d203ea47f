#include "simulate/cluster/launch.h"

#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <string>
#include <string_view>

namespace sunfleck {
namespace {

std::optional<int> number_of(const char* text, int least) {
  if (text == nullptr) return std::nullopt;
  const std::string_view digits = text;
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < least) return std::nullopt;
  return number;
}

bool says_no(const std::string& setting) {
  constexpr std::string_view words[] = {"off", "no", "false", "0"};
  return std::find(std::begin(words), std::end(words), lower_case(setting)) != std::end(words);
}

}  // namespace

std::optional<Launch> launch_by_mpi(const Environment& environment) {
  const char* setting = environment("SUNFLECK_MPI");
  if (setting != nullptr && says_no(setting)) return std::nullopt;
  struct Names {
    const char* rank;
    const char* ranks;
    bool both;  // true if only both variables together identify the launcher
  };
  for (const Names& names : {Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", true}, Names{"PMI_RANK", "PMI_SIZE", true},
                             Names{"PMIX_RANK", "SLURM_STEP_NUM_TASKS", false}}) {
    const std::optional<int> rank = number_of(environment(names.rank), 0);
    const std::optional<int> ranks = number_of(environment(names.ranks), 1);
    if (!rank || (names.both && !ranks) || (ranks && *rank >= *ranks)) continue;
    return Launch{*rank, ranks};
  }
  return std::nullopt;
}

std::optional<Launch> launch_by_mpi() {
  return launch_by_mpi([](const char* name) { return std::getenv(name); });
}

bool is_worker_rank() {
  const std::optional<Launch> launch = launch_by_mpi();
  return launch && launch->rank > 0;
}

}  // namespace sunfleck

#pragma once
// Scenes with known light, run on the user's own device.

#include "programs/validate/case_bench.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sunfleck {

// Cases that share scenes.
struct CaseGroup {
  const char* name;
  std::size_t estimates;  // rows of compare(); the verdicts are for the table of all groups
  void (*run)(CaseBench& bench);
};

[[nodiscard]] std::span<const CaseGroup> all_case_groups();

// Returns the groups whose names contain one of the parts, ignoring case; all groups if there are no parts. Throws Error
// (input) for a part that no name contains.
[[nodiscard]] std::vector<CaseGroup> choose_case_groups(const std::vector<std::string>& parts);

struct JudgedAnswer {
  KnownAnswer answer;
  bool passed = false;
};

// Runs the groups; calls `report` with each row when its group is done. A group that fails becomes one row that gives the
// reason, and the others continue. Returns false if stopped. Lets Error of kind device and lack of memory pass through.
[[nodiscard]] bool run_case_groups(std::span<const CaseGroup> groups, CaseBench& bench,
                                   const std::function<void(const JudgedAnswer&)>& report);

}  // namespace sunfleck

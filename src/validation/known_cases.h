#pragma once
// Scenes with known light, run on the user's own device.

#include "validation/case_bench.h"

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

// The groups, by topic.
void beam_cases(CaseBench& bench);
void wrap_cases(CaseBench& bench);
void view_factor_cases(CaseBench& bench);
void endless_strip_cases(CaseBench& bench);
void parallel_plate_cases(CaseBench& bench);
void plate_over_soil_cases(CaseBench& bench);
void furnace_cases(CaseBench& bench);
void cavity_cases(CaseBench& bench);
void random_leaf_cases(CaseBench& bench);
void two_stream_cases(CaseBench& bench);
void explicit_scene_cases(CaseBench& bench);
void sky_integral_cases(CaseBench& bench);
void sky_light_cases(CaseBench& bench);
void sun_position_cases(CaseBench& bench);
void sun_event_cases(CaseBench& bench);
void weather_cases(CaseBench& bench);
void counter_cases(CaseBench& bench);
void ledger_cases(CaseBench& bench);
void device_cases(CaseBench& bench);

}  // namespace sunfleck

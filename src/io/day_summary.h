#pragma once
// summary.json of a day.

#include "io/day_course.h"
#include "io/result_writer.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

// Of all simulated steps together; errors are those of the worst one.
struct DayTotals {
  std::size_t simulated = 0;
  std::size_t short_of_bound = 0;
  std::uint64_t rays = 0, packets = 0, lost_rays = 0;
  std::optional<double> direct_error, indirect_error;
  double seconds = 0.0;
};

struct DaySummary {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  std::span<const StepLight> lights;  // of the first steps, those done
  const DayTotals& totals;
  const nlohmann::ordered_json& settings;  // that the result depends on
};

// As text, two spaces of indent.
[[nodiscard]] std::string day_summary_json(const DaySummary& day);

// A short table of each date's sums, for people.
[[nodiscard]] std::string day_report(const DaySummary& day);

}  // namespace sunfleck

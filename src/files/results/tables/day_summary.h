#pragma once
// The summary.json of a day.

#include "files/results/tables/day_course.h"
#include "files/results/tables/result_writer.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

namespace sunfleck {

// Totals over all simulated steps; the errors are those of the worst step.
struct DayTotals {
  std::size_t simulated = 0;
  std::size_t short_of_bound = 0;
  std::uint64_t rays = 0, packets = 0, lost_rays = 0;
  std::optional<double> direct_error, indirect_error, sensor_error;
  double seconds = 0.0;
};

struct DaySummary {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  std::size_t steps_done = 0;      // number of finished steps, from the first
  std::span<const DateSums> sums;  // [date], of the finished steps; only those of the bands are used
  const DayTotals& totals;
  const nlohmann::ordered_json& settings;  // the settings that determine the result
};

// Returns the JSON text, indented by two spaces.
[[nodiscard]] std::string day_summary_json(const DaySummary& day);

// Returns a short table for the terminal: the sums of each date or, for more than seven dates, of all of them.
[[nodiscard]] std::string day_report(const DaySummary& day);

}  // namespace sunfleck

#pragma once
// The tables of a day: day.csv, day_sums.csv, organs_day.csv and plants_day.csv. `lights` holds the light of the first steps of the course:
// all of them, or those finished before the day was stopped; in that case a line of the tables says so.

#include "files/results/tables/day_course.h"
#include "files/results/tables/result_writer.h"
#include "files/results/tables/table.h"

#include <span>
#include <string>

namespace sunfleck {

// Returns one row per step.
[[nodiscard]] Table steps_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights);
// Returns one row per date that has steps: the sums of its steps.
[[nodiscard]] Table day_sums_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights);
// Returns the rows of organs.csv for each date that has steps; its axes are date and organ.
[[nodiscard]] Table organs_day_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights);

// Returns the rows of plants.csv for each date that has steps; its axes are date and plant.
[[nodiscard]] Table plants_day_table(const RadiationModel& model, const DayCourse& course, std::span<const StepLight> lights);

[[nodiscard]] std::string day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                  std::span<const StepLight> lights);
[[nodiscard]] std::string day_sums_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                       std::span<const StepLight> lights);
[[nodiscard]] std::string organs_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                         std::span<const StepLight> lights);
[[nodiscard]] std::string plants_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                         std::span<const StepLight> lights);

}  // namespace sunfleck

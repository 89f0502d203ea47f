#pragma once
// day.csv and organs_day.csv as text. Numbers have nine significant digits.

#include "io/day_course.h"
#include "io/result_writer.h"

#include <span>
#include <string>
#include <vector>

namespace sunfleck {

[[nodiscard]] std::vector<double> organ_areas_m2(const Canopy& canopy);  // [organ], one-sided

// `lights` are those of the first steps of the course: all of them, or those done before the day was stopped, which the
// tables say in a line of their own.
[[nodiscard]] std::string day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                  std::span<const StepLight> lights);
// Rows as in organs.csv, for each date.
[[nodiscard]] std::string organs_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                         std::span<const StepLight> lights);

}  // namespace sunfleck

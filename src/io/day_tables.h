#pragma once
// day.csv and organs_day.csv as text. Numbers have nine significant digits.

#include "io/day_course.h"
#include "io/result_writer.h"

#include <span>
#include <string>
#include <vector>

namespace sunfleck {

[[nodiscard]] std::vector<double> organ_areas_m2(const Canopy& canopy);  // [organ], one-sided

// Returns day.csv. `lights` holds the light of the first steps of the course: all of them, or those finished before the day was
// stopped; in that case a line of the tables says so.
[[nodiscard]] std::string day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                  std::span<const StepLight> lights);
// Returns organs_day.csv, with the rows of organs.csv for each date.
[[nodiscard]] std::string organs_day_csv(const RunRecord& record, const RadiationModel& model, const DayCourse& course,
                                         std::span<const StepLight> lights);

}  // namespace sunfleck

#pragma once
// Writes organs_steps.nc: what every organ absorbs at every step, as netCDF-4 with CF 1.8 attributes (xarray, R).

#include "files/results/tables/day_course.h"
#include "files/results/tables/day_stand.h"
#include "files/results/tables/result_writer.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace sunfleck {

struct OrganSteps {
  const RunRecord& record;
  const DayStand& stand;
  const DayCourse& course;
  std::size_t steps = 0;  // number of steps to write, from the first, > 0
  // Returns the light of a step that is not unlit.
  std::function<StepLight(std::size_t step)> light;
};

// Writes the dimensions time and organ, with plant, rank, name, role and area of each organ as coordinates, and for each band
// what both faces absorb per one-sided area with the half-width of its interval, in single precision, zero in unlit steps. Holds
// the values of one date in memory at a time. Writes to `aside`, which must be on the same file system, and renames it. Throws
// Error (failure).
void write_organ_steps(const std::filesystem::path& file, const std::filesystem::path& aside, const OrganSteps& organs);

}  // namespace sunfleck

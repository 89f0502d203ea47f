#pragma once
// Writes day.nc: the fields of every triangle at every step, as netCDF-4 with CF 1.8 attributes (xarray, R).

#include "files/results/tables/day_course.h"
#include "files/results/tables/result_writer.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace sunfleck {

struct DayFields {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  std::size_t steps = 0;  // number of steps to write, from the first, > 0
  // Returns the values of a step that is not unlit, laid out as by day_fields (files/results/tables/day_fields.h).
  std::function<std::vector<float>(std::size_t step)> fields;
};

// Writes the dimensions time and triangle. The times are the starts of the steps in UTC, with their bounds; light is in single
// precision, zero in unlit steps. Holds one step in memory at a time. Writes to `aside`, which must be on the same file system, and
// renames it. Throws Error (failure).
void write_day_netcdf(const std::filesystem::path& file, const std::filesystem::path& aside, const DayFields& day);

}  // namespace sunfleck

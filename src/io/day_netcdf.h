#pragma once
// day.nc: the fields of every triangle at every step, netCDF-4 with CF 1.8 attributes (xarray, R).

#include "io/day_course.h"
#include "io/result_writer.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace sunfleck {

struct DayFields {
  const RunRecord& record;
  const RadiationModel& model;
  const DayCourse& course;
  std::size_t steps = 0;  // of the course, from its first, > 0
  // Of a step that is no night, as day_fields has them.
  std::function<std::vector<float>(std::size_t step)> fields;
};

// Dimensions time and triangle; times are the steps' starts in UTC, with their bounds. Light in single precision, zero at
// night. Holds one step in memory at a time. Written to `aside`, in the same file system, and renamed.
// Throws Error (failure).
void write_day_netcdf(const std::filesystem::path& file, const std::filesystem::path& aside, const DayFields& day);

}  // namespace sunfleck

#pragma once
// The time axis of the netCDF files of a day, after CF 1.8.

#include "files/results/exports/netcdf_file.h"
#include "files/results/tables/day_course.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace sunfleck {

// Adds the dimension time and its coordinates for the first `steps` steps: their starts in UTC with their bounds, the sun at
// their middles, and the local times. Returns the number of the dimension.
int add_time_axis(NetcdfFile& file, const DayCourse& course, std::size_t steps);

// Calls `write`, which writes the file `aside`, and puts that in the place of `file`, which must be on the same file system.
// If that fails, `aside` is removed.
void write_aside(const std::filesystem::path& file, const std::filesystem::path& aside, const std::function<void()>& write);

}  // namespace sunfleck
